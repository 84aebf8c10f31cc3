"""Writes codes of the compact profile, from docs/SPEC.md 1.3 alone; and random ones."""

import types

import compact_profile
import second_decoder
from refusals import Refused


class Writer:
    """The number that the decisions are taken from: all of low … low + range - 1 lead to them."""

    def __init__(self):
        self.models = compact_profile.Models()
        self.low, self.range, self.bytes = 0, 1, 0

    def fill(self):
        while self.range < 1 << 16:
            self.low, self.range, self.bytes = self.low << 8, self.range << 8, self.bytes + 1

    def one_of(self, n, v):
        assert 0 <= v < n
        self.fill()
        self.range //= n
        self.low += v * self.range

    def bit(self, bit, name, k=0, context=0):
        self.fill()
        model = name, k, context
        t = self.models.split(model, self.range)
        if bit:
            self.low += t
        self.range = self.range - t if bit else t
        self.models.learn(model, bit)

    def number(self, value, name, context=0):
        c = (value + 1).bit_length() - 1
        assert 0 <= c <= 14
        for i in range(c):
            self.bit(1, name, min(i, 5), context)
        if c < 14:
            self.bit(0, name, min(c, 5), context)
        for i in reversed(range(c)):
            self.one_of(2, (value + 1) >> i & 1)

    def signed(self, value, name):
        self.number(2 * value if value >= 0 else -2 * value - 1, name)

    def difference(self, value, name, down):
        self.number(abs(value), name)
        if value:
            self.bit(value < 0, down)

    def turn(self, sector, context):
        b2, b1, b0 = sector >> 2, sector >> 1 & 1, sector & 1
        self.bit(b2, "TURN", 0, context)
        self.bit(b1, "TURN", 1 + b2, context)
        self.bit(b0, "TURN", 3 + 2 * b2 + b1, context)

    def end(self, seed, sections):
        """The code: relief, sections and check."""
        self.fill()
        block = (self.low + 0x7FFF) >> 15
        relief = (block << 7 | seed).to_bytes(self.bytes - 1, "big")
        code = b"\x21" + relief + sections
        code += bytes([second_decoder.crc8(code)])
        number = int.from_bytes(code[1 : 1 + self.bytes], "big")
        assert self.low <= number < self.low + self.range
        return code


def ring_number(dx, dy):
    """Counter-clockwise from (n, 0)."""
    n = max(abs(dx), abs(dy))
    if dx == n:
        return dy % (8 * n)
    if dy == n:
        return 2 * n - dx
    if dx == -n:
        return 4 * n - dy
    return 6 * n + dx


def frame_way(place, east, north):
    x, y = place
    if y == 0:
        return x
    if x == east:
        return east + y
    return 2 * east + north - x if y == north else 2 * (east + north) - y


class Sheet:
    """Writes a plan: a namespace with the header's numbers as they are coded, east and north in
    spacings, and lines, spots, corners, frame in units above the base."""

    def __init__(self, plan, rng):
        self.put, self.plan, self.rng = Writer(), plan, rng
        self.known = []

    def nearest(self, place):
        return min(((x - place[0]) ** 2 + (y - place[1]) ** 2, k, h)
                   for k, (x, y, h) in enumerate(self.known))[2] if self.known else 0

    def code(self):
        self.header()
        self.put.number(len(self.plan.lines), "LINES")
        centre, way = (self.plan.east // 2, self.plan.north // 2), 0
        for line, height, is_open in self.plan.lines:
            self.put.bit(is_open, "CLOSED")
            if is_open:
                round_trip = 2 * (self.plan.east + self.plan.north)
                to = frame_way(line[0], self.plan.east, self.plan.north)
                on = (to - way) % round_trip - round_trip * self.rng.choice((0, 0, 0, 1, 1, 2))
                self.put.signed(on, "WAY")
                way = to
            else:
                for k in range(2):
                    self.put.signed(line[0][k] - centre[k], "START")
                centre = line[0]
            rise, odd = divmod(height - self.nearest(line[0]), self.plan.interval)
            assert odd == 0
            self.put.difference(rise, "LINE_HEIGHT", "LINE_DOWN")
            self.steps(line, is_open)
            self.known += [(*p, height) for p in line]
        self.corners()
        self.spots()
        self.put.bit(bool(self.plan.sections), "SECTIONS")
        return self.put.end(self.plan.seed, self.plan.sections)

    def header(self):
        put, plan = self.put, self.plan
        put.one_of(16, plan.cell[0])
        put.one_of(256, plan.cell[1])
        put.one_of(16, plan.spacing - 1)
        longer, oblong = 255 // plan.spacing, plan.east != plan.north or plan.oblong
        put.bit(oblong, "OBLONG")
        if oblong:
            upright = plan.east < longer
            put.one_of(2, upright)
            put.one_of(longer, (plan.east if upright else plan.north) - 1)
        put.one_of(16, plan.unit[0])
        put.one_of(16, plan.unit[1])
        put.bit(plan.interval > 1, "COARSE")
        if plan.interval > 1:
            put.one_of(3, plan.interval.bit_length() - 2)
        put.number(abs(plan.base), "BASE")
        if plan.base:
            put.one_of(2, plan.base < 0)
        put.one_of(32, plan.dimension)
        put.one_of(16, plan.gain)
        put.bit(plan.straight, "STRAIGHT")
        put.one_of(16, plan.vertices)

    def overshot(self, place):
        """A place outside of the frame that is moved to this one on it, or the place itself."""
        x, y = place
        if self.rng.random() < 0.3:
            far = self.rng.choice((1, 3, 30))
            x += (x == self.plan.east) * self.rng.randrange(far)
            x -= (x == 0) * self.rng.randrange(far)
            y += (y == self.plan.north) * self.rng.randrange(far)
            y -= (y == 0) * self.rng.randrange(far)
        return x, y

    def first_step(self, place):
        """l and q of the step before the first one of an open line."""
        side = sum(frame_way(place, self.plan.east, self.plan.north) >= way for way in (
            self.plan.east, self.plan.east + self.plan.north, 2 * self.plan.east + self.plan.north))
        return 1, (2, 4, 6, 0)[side]

    def steps(self, line, is_open):
        put = self.put
        l, q = self.first_step(line[0]) if is_open else (1, 0)
        length_at, turn_at = 0, 0 if is_open else 1
        for k, (at, to) in enumerate(zip(line, line[1:])):
            aim = self.overshot(to) if is_open and k + 2 == len(line) else to
            dx, dy = aim[0] - at[0], aim[1] - at[1]
            n = max(abs(dx), abs(dy))
            if n > 255:
                dx, dy = to[0] - at[0], to[1] - at[1]
                n = max(abs(dx), abs(dy))
            number = ring_number(dx, dy)
            sector, rest = divmod((number - (q * n + l // 2) // l + n // 2) % (8 * n), n)
            put.number(n - 1, "LENGTH", length_at)
            put.turn(sector, turn_at)
            put.one_of(n, rest)
            l, q = n, number
            length_at = sum(n >= least for least in (1, 2, 4, 8))
            turn_at = (2, 3, 3, 3, 2, 4, 4, 4)[sector]
            if not is_open and k >= 1:
                near = max(abs(to[0] - line[0][0]), abs(to[1] - line[0][1])) <= 2 * n
                put.bit(k + 2 == len(line), "END", int(near))

    def corners(self):
        east, north = self.plan.east, self.plan.north
        for place, height in zip(((0, 0), (east, 0), (east, north), (0, north)),
                                 self.plan.corners):
            self.put.bit(height is not None, "CORNER")
            if height is not None:
                self.corner(height, place)
        if self.plan.corners == [None] * 4:
            self.corner(self.plan.frame, (0, 0))

    def corner(self, height, place):
        self.put.difference(height - self.nearest(place), "CORNER_HEIGHT", "CORNER_DOWN")

    def spots(self):
        across = self.plan.east - 1
        spots = sorted(((y - 1) * across + x - 1, x, y, h) for (x, y), h in self.plan.spots)
        self.put.number(len(spots), "SPOTS")
        passed = 0
        for k, (number, x, y, height) in enumerate(spots):
            left = across * (self.plan.north - 1) - passed
            run = min(max(11 * left // (16 * (len(spots) - k + 1)), 1), 4096)
            runs, rest = divmod(number - passed, run)
            for bit in [1] * runs + [0]:
                self.put.bit(bit, "GAP")
            self.put.one_of(run, rest)
            self.put.difference(height - self.nearest((x, y)), "SPOT_HEIGHT", "SPOT_DOWN")
            self.known.append((x, y, height))
            passed = number + 1


# --- Random plans ---------------------------------------------------------------------------------


def moved(at, from_side, to_side):
    """A coordinate on another lattice; what is on the frame or inside it stays so."""
    if at in (0, from_side):
        return at and to_side
    return min(max(round(at * to_side / from_side), 1), max(to_side - 1, 1))


def legal(plan, contours):
    """By 1.6; sets which are open."""
    sheet = types.SimpleNamespace(east=plan.east, north=plan.north, corner=plan.corners, points=[],
                                  contours=[])
    for line, height in contours:
        sheet.contours.append(second_decoder.Contour(len(sheet.points), len(line), height))
        sheet.points += line
    try:
        second_decoder.check_contours(sheet)
    except Refused:
        return None
    return [contour.open for contour in sheet.contours]


def take_contours(plan, paper, rng):
    """Those of a plan of the paper profile that are still legal on the new lattice."""
    kept = []
    for contour in paper.contours:
        line = []
        for v in contour.points():
            x, y = paper.points[v]
            place = moved(x, paper.east, plan.east), moved(y, paper.north, plan.north)
            if place not in line:
                line.append(place)
        if len(line) < contour.count and len(line) < 3:
            continue
        height = plan.height(contour.height)
        if len(line) > 1:
            height -= height % plan.interval
        if legal(plan, kept + [(line, height)]) is not None:
            kept.append((line, height))
    opens = legal(plan, kept)
    both = list(zip(kept, opens))
    plan.lines = [(line, height, is_open) for (line, height), is_open in both if len(line) > 1]
    plan.spots = [(line[0], height) for (line, height), _ in both if len(line) == 1]


def random_sections(rng):
    """Up to three, or none."""
    count, sections = rng.choice((0, 0, 0, 1, 2, 3)), b""
    for k in range(count):
        size = rng.choice((0, 1, 2, 7, 14, 15, 16, 300))
        sections += bytes([(k + 1 == count) << 7 | rng.randrange(8) << 4 | min(size, 15)])
        if size >= 15 or rng.random() < 0.1:
            sections = sections[:-1] + bytes([sections[-1] | 15]) + size.to_bytes(2, "big")
        sections += rng.randbytes(size)
    return sections


def random_frame(plan, paper, rng):
    plan.spacing = rng.choice((1, 1, 1, 2, 3, rng.randint(1, 16)))
    plan.east = plan.north = longer = 255 // plan.spacing
    plan.oblong = rng.random() < 0.05
    if paper.east > paper.north:
        plan.north = max(1, longer * paper.north // paper.east)
    elif paper.north > paper.east:
        plan.east = max(1, longer * paper.east // paper.north)


def random_heights(plan, paper, rng):
    """Cell, unit and base."""
    plan.cell = rng.choice((rng.randrange(16), 4, 5)), rng.randrange(1, 256)
    e, f = plan.cell
    cell = f if e == 0 else (256 + f) << (e - 1)
    highest = max([contour.height for contour in paper.contours], default=0)
    unit = cell * highest // (256 * rng.choice((3, 10, 50, 200, 1000, 5000)))
    plan.unit = min(max(unit.bit_length() - 5, 0), 15), rng.randrange(16)
    unit = (16 + plan.unit[1]) << plan.unit[0]
    plan.interval = rng.choice((1, 1, 1, 2, 4, 8))
    down = rng.choice((0, 0, rng.randrange(200)))
    plan.height = lambda z: min(z * cell // (256 * unit), 9999) - down
    most = min(32766, ((1 << 15) - 1) * 64 // unit)
    plan.base = rng.choice((0, rng.randint(0, 1 << rng.randrange(15)))) * rng.choice((1, -1))
    plan.base = min(max(plan.base, -most), most)


def random_code(paper, rng, most_class=7):
    """Writes what a plan of the paper profile shows, as well as another lattice and other units can
    say it. Gives the plan and its code."""
    plan = types.SimpleNamespace(corners=[None] * 4)
    random_frame(plan, paper, rng)
    random_heights(plan, paper, rng)
    plan.dimension, plan.gain = rng.randrange(32), rng.randrange(16)
    plan.straight, plan.seed = rng.random() < 0.3, rng.randrange(128)
    plan.vertices = rng.choice((most_class, most_class, rng.randint(0, most_class)))
    take_contours(plan, paper, rng)
    ends = {line[k] for line, _, is_open in plan.lines if is_open for k in (0, -1)}
    places = (0, 0), (plan.east, 0), (plan.east, plan.north), (0, plan.north)
    if rng.random() < 0.5:
        plan.corners = [None if place in ends or rng.random() < 0.4 else
                        plan.height(rng.randrange(5000)) for place in places]
    plan.frame = plan.height(rng.randrange(5000))
    plan.sections = random_sections(rng)
    return plan, Sheet(plan, rng).code()
