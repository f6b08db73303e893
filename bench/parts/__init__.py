"""Parts made by script as files, the sweep over them, and its table."""
