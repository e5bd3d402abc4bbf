"""Where a hull lies in its file: base line, perpendiculars and design waterline, one rule for all."""
