"""The booklet of a hull: what is known of it in one PDF, or its tables in one workbook."""
