"""What a hull consists of: points, curves, lines, groups, crossings, associations."""
