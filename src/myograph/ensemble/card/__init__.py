"""The data card of a store: what it is, how it was made, what is in it and what not to trust; for people.

`card.md` is written at the end of every run; the figure beside it, `card.png`, is drawn by the command line.
"""
