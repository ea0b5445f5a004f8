"""Many cases: their design, the labelled dataset of one muscle, and the pairs and protocols that learning reads."""
