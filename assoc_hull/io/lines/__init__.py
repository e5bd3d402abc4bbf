"""Lines as points: the types that readers, cutters and writers share."""
