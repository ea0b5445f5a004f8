"""Material laws by name: parameters, energies, stresses; knows no muscles and no finite elements."""
