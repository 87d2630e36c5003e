"""The command line as ``python -m coplanar``."""

from coplanar.cli import main

if __name__ == "__main__":
    main()
