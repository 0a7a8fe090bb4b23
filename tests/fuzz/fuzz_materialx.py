"""MaterialX, which may include itself."""

from foreign import fuzz, survive


def read(content: bytes) -> None:
    survive(content, ".mtlx")


if __name__ == "__main__":
    fuzz(read)
