"""`python -m myograph` is the command `myograph`."""

from myograph.cli import main

if __name__ == "__main__":
    main()
