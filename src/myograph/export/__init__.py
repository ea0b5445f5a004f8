"""Files for other programs: VTKHDF for ParaView, CSV for tables, PLAID for other learners.

It reads what came of cases and knows neither pictures nor networks.
"""
