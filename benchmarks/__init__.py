"""Each workload beside its peers: do the answers agree, how long does each take, how far is that from the limit."""
