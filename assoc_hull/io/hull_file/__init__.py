"""The hull file: a database that holds a hull with all that was ever committed to it."""
