"""The canonical form of a hull: records, columns, fingerprint, schema, restoring and verifying."""
