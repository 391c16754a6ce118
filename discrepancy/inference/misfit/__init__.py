"""Where the fitted model fails, by functions of a record that know no cause."""
