"""What an update does after each pass: crossings, gaps, features, generated curves."""
