"""Tables and documents of results: CSV, XLSX, text, JSON and its schemas."""
