"""How far to trust an answer: deviations, intervals that hold what they promise, and whether it is inside of training.

ensemble      several members of any method: their mean, and their spread as standard deviation
conformal     how many deviations hold 90 % of the truth, from cases that taught nothing
scores        how far a method is off, and how far it says it may be
calibrated    any method with such intervals and a verdict
nearness      whether activations are near those of training
coverage      what share of the truth the intervals hold on other cases
placing       which nodes are good sensors
"""
