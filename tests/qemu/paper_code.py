"""Codes of the paper profile, made from contours (docs/SPEC.md, section 1).

For tests that need a code of a known shape; it checks nothing that the decoder is there to check.
"""


def crc8(data):
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (0x107 if crc & 0x80 else 0)) & 0x1FF
    return crc


def sealed(data):
    """The code with its check byte."""
    return bytes(data) + bytes([crc8(data)])


def paper_code(contours, shift=2, side=255, cell=0x780, unit=0x280, seed=1, gain=32, frame=20,
               dimension=0x40):
    """contours: (height, [(x, y), ...]); differences between points are multiples of 2^shift."""
    header = [0x20, shift, len(contours), 255, side, side, cell >> 8, cell & 255,
              unit >> 8, unit & 255, 0, 0, seed, gain, frame >> 8, frame & 255]
    counts = [len(line) for _, line in contours]
    bits = f"{dimension:08b}"
    for height, line in contours:
        bits += f"{height:016b}{line[0][0]:08b}{line[0][1]:08b}"
        for (x0, y0), (x1, y1) in zip(line, line[1:]):
            for difference in (x1 - x0, y1 - y0):
                units, rest = divmod(difference, 1 << shift)
                if rest or not -32 <= units <= 31:
                    raise ValueError(f"a difference of {difference} at shift {shift}")
                bits += f"{units & 63:06b}"
    bits += "0" * (-len(bits) % 8)
    body = [int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)]
    return sealed(header + counts + body)


def two_summits():
    """A foot line round two separate summits of different height."""
    return paper_code([
        (40, [(236, 128), (188, 216), (100, 228), (28, 156), (20, 84), (92, 20), (196, 32)]),
        (110, [(108, 148), (76, 176), (48, 144), (64, 104), (96, 108)]),
        (90, [(212, 108), (188, 140), (152, 112), (172, 68)]),
        (200, [(76, 136)]),
        (140, [(184, 108)]),
    ], seed=42)
