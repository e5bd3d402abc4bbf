"""What lies below floating planes."""
