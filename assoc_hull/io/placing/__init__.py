"""Where a hull lies in its file: base line, perpendiculars, design waterline; one rule for all."""
