"""What links weigh: bars, rigid bodies, and where each number comes from."""
