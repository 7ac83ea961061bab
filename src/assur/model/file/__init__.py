"""Reading a mechanism file: TOML text, its form, its formulas evaluated, every fault noted, a record at the end."""
