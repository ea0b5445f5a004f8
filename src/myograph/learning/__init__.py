"""Graph element networks, the baselines they must beat, training and saved models; the only room that imports torch.

The baselines (`predictor`, `baselines`) run without torch.
"""
