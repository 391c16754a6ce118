"""How sure is the life: wear parameters and remaining life from the first inspections, with intervals."""
