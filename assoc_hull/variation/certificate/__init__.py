"""The fold check: certificates that a map is one to one, and how far it may go."""
