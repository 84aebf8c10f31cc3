"""What a decoder answers instead of a map."""


class Refused(Exception):
    """truncated, corrupt, version or limit; `after` so many bytes"""

    after = None


def refuse_if(wrong, why="corrupt"):
    if wrong:
        raise Refused(why)
