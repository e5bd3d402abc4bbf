"""A sheet of paper in millimetres: pens, letters, labels, blocks, charts, pages."""
