"""The tests of standards and data sheets: procedures on the virtual bench, and one evaluation for them and for measured files."""
