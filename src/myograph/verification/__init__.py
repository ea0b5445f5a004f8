"""Published reference values and closed forms, and what our finite elements give for them."""
