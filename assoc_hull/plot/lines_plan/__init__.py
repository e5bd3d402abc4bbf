"""Pictures of the lines of a hull: lines plan, combs, before and after, comparison."""
