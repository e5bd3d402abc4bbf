"""What a designer asks for: one module for each kind of modification."""
