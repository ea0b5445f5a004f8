"""What a card says of stores of one kind: by a simulator's kind, 'own' for simulators of the user."""

_FINITE_ELEMENTS = (
    "A muscle with its tendons is one nearly incompressible, hyperelastic body with fibres: displacement u and "
    "pressure p make the energy ∫ W(F, p) dV + contact stationary, F = 1 + grad u; the fibres of an activated "
    "muscle add an active stress. The origin's face is held, the insertion's face moves with the forearm, the "
    "skin keeps out of the bones. The elbow rests where the moments of the muscles, of the forearm's weight and "
    "of the weight in the hand balance; with a prescribed angle it does not move. In myograph's documentation: "
    "`docs/mechanics.md`, `docs/limb.md`, `docs/conventions.md`."
)

ORIGINS = {
    "direct": "Every case was solved by finite elements at the size '{preset}'.",
    "table": "Every case was interpolated by splines between finite-element states of the size '{preset}'.",
    "import": "The data are those of another program, imported as '{preset}'.",
    "own": "Every case was computed by the user's simulator `{kind}` with '{preset}'.",
}

EQUATIONS = {
    "direct": _FINITE_ELEMENTS,
    "table": f"{_FINITE_ELEMENTS} Between the states of an adaptive sparse grid fields follow cubic splines:"
    " `docs/tables.md`.",
    "import": "Those of the program that made the data: myograph has not seen them.",
    "own": "Those of the simulator: myograph does not know them.",
}

_ARM = (
    "Material parameters are fitted to published forces, not measured; three of the muscles have no published forces.",
    "Muscles do not touch each other; bones are capsules.",
    "Statics only: no inertia, no viscosity, no force–velocity relation.",
    "Stress at the clamped end faces depends on the mesh.",
    "Fields are rounded to single precision: 3e-5 mm in a position.",
    "More in myograph's documentation: `docs/limits.md`.",
)

LIMITS = {
    "direct": _ARM,
    "table": (
        "Between the states of the table a node is off by some tenths of a millimetre at most in the mean.",
        *_ARM,
    ),
    "import": (
        "Units, node numbers and signs are what the mapping said; nothing can check them.",
        "Fields are rounded to single precision.",
    ),
    "own": ("What the simulator's makers say of it.", "Fields are rounded to single precision."),
}

_YOURS = "The data are yours: whoever ran the computation decides. myograph (MIT) makes no claim on what it computes"

LICENCE = {
    "direct": f"{_YOURS}; to give them away without conditions, CC0 1.0 fits.",
    "table": f"{_YOURS}; to give them away without conditions, CC0 1.0 fits.",
    "import": "That of the imported data: ask whoever made them. myograph makes no claim on them.",
    "own": f"{_YOURS}; mind the licence of the simulator.",
}

TRUNCATED = "{count} cases of a muscle could not be read and are left out here; see `myograph ensemble check`."
