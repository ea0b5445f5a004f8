"""Pairs of cases: what a method is told of them, what it is asked, which of them teach and which test.

question     what a method is told and asked; what it answers; what is right
sampler      questions about any pairs of the cases of one muscle, read from where these lie
features     quantities at a point in both cases, as networks take and give them
protocols    which pairs teach and which test
predictor    what can answer, and what can learn to
"""
