"""``python -m coplanar.play``: the playground with its defaults."""

from coplanar.play.app import play

if __name__ == "__main__":
    play()
