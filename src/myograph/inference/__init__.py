"""Trained models to be used: read from a folder, run by onnxruntime; nothing here knows torch, nothing is unpickled.

signature    what a model takes and gives, by name
feeds        the one table of how an input is taken out of a Question
answers      what a model gives becomes an Answer
question     the check of what a model is asked
"""
