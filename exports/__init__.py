"""Results as files for other programs: CSV, Parquet, MAT, Excel."""
