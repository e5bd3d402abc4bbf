"""Panels in files of seakeeping codes."""
