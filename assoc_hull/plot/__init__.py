"""Pictures of hulls and of reports."""
