"""Which filter of a synthesis drops a mechanism: by directions, by virtual chains, by constraints at home."""
