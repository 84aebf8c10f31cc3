"""The compact profile, read from docs/SPEC.md 1.3 alone; its start values from the page itself."""

import pathlib
import re

from refusals import refuse_if

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "SPEC.md"
HIGHEST = 131072
WHOLE_RANGE = 1 << 16


def start_values():
    """The table of the page: {models: [values of a context, ...]}"""
    rows = PAGE.read_text().split("| models | start values |\n")[1].split("\n\n")[0]
    found = re.findall(r"^\| ([A-Z_]+) \| (.+) \|$", rows, re.MULTILINE)
    return {name: [list(map(int, context.split(", "))) for context in values.split(" · ")]
            for name, values in found}


START_VALUES = start_values()


class Models:
    """All models of a code: at(name, k, context) is a key of `value`."""

    def __init__(self):
        self.value = {(name, k, context): value << 8
                      for name, contexts in START_VALUES.items()
                      for context, values in enumerate(contexts)
                      for k, value in enumerate(values)}

    def split(self, model, range_):
        """The part of the range that is a 0."""
        return (range_ >> 12) * (self.value[model] >> 4)

    def learn(self, model, bit):
        m = self.value[model]
        self.value[model] = m - m // 32 if bit else m + (65535 - m) // 32


class Decisions:
    """Decisions from bytes."""

    def __init__(self, read):
        self.read, self.models = read, Models()
        self.range, self.code = 1, 0

    def fill(self):
        while self.range < WHOLE_RANGE:
            self.code = (self.code << 8 | self.read.number(1)) % (1 << 32)
            self.range <<= 8

    def one_of(self, n):
        self.fill()
        part = self.range // n
        v = min(self.code // part, n - 1)
        self.code -= v * part
        self.range = part
        return v

    def bit(self, name, k=0, context=0):
        self.fill()
        model = name, k, context
        t = self.models.split(model, self.range)
        bit = int(self.code >= t)
        if bit:
            self.code -= t
            self.range -= t
        else:
            self.range = t
        self.models.learn(model, bit)
        return bit

    def number(self, name, context=0):
        c = 0
        while c < 14 and self.bit(name, min(c, 5), context):
            c += 1
        u = 0
        for _ in range(c):
            u = 2 * u + self.one_of(2)
        return (1 << c) - 1 + u

    def turn(self, context):
        b2 = self.bit("TURN", 0, context)
        b1 = self.bit("TURN", 1 + b2, context)
        b0 = self.bit("TURN", 3 + 2 * b2 + b1, context)
        return 4 * b2 + 2 * b1 + b0

    def signed(self, name):
        w = self.number(name)
        return w // 2 if w % 2 == 0 else -(w + 1) // 2

    def difference(self, name, down):
        n = self.number(name)
        return -n if n and self.bit(down) else n


# --- Geometry -------------------------------------------------------------------------------------


def place_of_way(way, east, north):
    """On the frame, counter-clockwise from the south-west corner."""
    way %= 2 * (east + north)
    if way < east:
        return way, 0
    if way < east + north:
        return east, way - east
    if way < 2 * east + north:
        return 2 * east + north - way, north
    return 0, 2 * (east + north) - way


def way_in(place, east, north):
    """q of the way into the frame from a place on it, for l = 1"""
    x, y = place
    if y == 0 and x < east:
        return 2
    if x == east and y < north:
        return 4
    return 6 if y == north and x > 0 else 0


def ring_place(n, number):
    """The place of a number on the square ring of n."""
    number %= 8 * n
    if number < n:
        return n, number
    if number < 3 * n:
        return 2 * n - number, n
    if number < 5 * n:
        return -n, 4 * n - number
    if number < 7 * n:
        return number - 6 * n, -n
    return n, number - 8 * n


def straight_on(q, length, n):
    """The number on the ring of n from which sectors are counted."""
    return (q * n + length // 2) // length - n // 2


def length_context(length):
    return 1 if length == 1 else 2 if length <= 3 else 3 if length <= 7 else 4


def turn_context(sector):
    return 2 if sector in (0, 4) else 3 if sector < 4 else 4


def nearest_height(known, place):
    """`known`: (x, y, height) in code order"""
    x, y = place
    return min(known, key=lambda p: (p[0] - x) ** 2 + (p[1] - y) ** 2, default=(0, 0, 0))[2]


def run_length(left, spots):
    """Places that a 1 passes."""
    return min(max(11 * left // (16 * (spots + 1)), 1), 4096)


# --- The relief -----------------------------------------------------------------------------------


class Relief:
    """Reads the relief into a plan; `lines` are lists of places in spacings, with a height each."""

    def __init__(self, read, plan, room):
        self.decide, self.plan, self.room = Decisions(read), plan, room
        self.known = []
        self.lines = []

    def header(self):
        decide, plan = self.decide, self.plan
        e, f = decide.one_of(16), decide.one_of(256)
        refuse_if(e == 0 and f == 0)
        plan.cell = f if e == 0 else (256 + f) << (e - 1)
        self.spacing = decide.one_of(16) + 1
        self.east = self.north = 255 // self.spacing
        if decide.bit("OBLONG"):
            if decide.one_of(2):
                self.east = decide.one_of(self.north) + 1
            else:
                self.north = decide.one_of(self.east) + 1
        e, f = decide.one_of(16), decide.one_of(16)
        plan.unit = (16 + f) << e
        self.interval = 2 << decide.one_of(3) if decide.bit("COARSE") else 1
        base = decide.number("BASE")
        if base and decide.one_of(2):
            base = -base
        plan.base, self.cut_off = divmod(base * plan.unit, 64)
        plan.hurst = 256 - 8 * decide.one_of(32)
        v = decide.one_of(16)
        plan.gain = 0 if v == 0 else (181 if v % 2 else 128) >> (7 - v // 2)
        plan.smooth = not decide.bit("STRAIGHT")
        v = decide.one_of(16)
        plan.most_vertices = (32 * (v + 1) if v < 8 else 1 << (v + 1)) - (v in (7, 15))
        refuse_if(plan.most_vertices > self.room, "limit")
        return decide.number("LINES")

    def add(self, place, height):
        refuse_if(len(self.known) == self.plan.most_vertices)
        self.known.append((*place, height))

    def outside(self, place):
        return not (0 <= place[0] <= self.east and 0 <= place[1] <= self.north)

    def all_lines(self, count):
        way, start = 0, (self.east // 2, self.north // 2)
        for _ in range(count):
            if self.decide.bit("CLOSED"):
                way += self.decide.signed("WAY")
                self.line(place_of_way(way, self.east, self.north), True)
            else:
                east = self.decide.signed("START")
                start = start[0] + east, start[1] + self.decide.signed("START")
                refuse_if(self.outside(start))
                self.line(start, False)

    def line(self, start, is_open):
        height = nearest_height(self.known, start)
        height += self.decide.difference("LINE_HEIGHT", "LINE_DOWN") * self.interval
        self.add(start, height)
        line, ended = [start], False
        step, contexts = (1, way_in(start, self.east, self.north) if is_open else 0), None
        while not ended:
            step, contexts, place = self.step(line[-1], step, contexts, is_open)
            if is_open:
                place = (min(max(place[0], 0), self.east), min(max(place[1], 0), self.north))
                ended = place[0] in (0, self.east) or place[1] in (0, self.north)
            refuse_if(self.outside(place))
            self.add(place, height)
            line.append(place)
            if not is_open and len(line) >= 3:
                far = max(abs(place[0] - start[0]), abs(place[1] - start[1]))
                ended = self.decide.bit("END", int(far <= 2 * step[0]))
        self.lines.append((line, height))

    def step(self, at, before, contexts, is_open):
        """One step: (its length and number), the contexts of the next one, where it ends."""
        length, q = before
        length_at, turn_at = contexts or (0, 0 if is_open else 1)
        n = 1 + self.decide.number("LENGTH", length_at)
        refuse_if(n > 255)
        sector = self.decide.turn(turn_at)
        number = (straight_on(q, length, n) + n * sector + self.decide.one_of(n)) % (8 * n)
        dx, dy = ring_place(n, number)
        return ((n, number), (length_context(n), turn_context(sector)),
                (at[0] + dx, at[1] + dy))

    def corners(self):
        heights = []
        for corner in ((0, 0), (self.east, 0), (self.east, self.north), (0, self.north)):
            heights.append(self.corner_height(corner) if self.decide.bit("CORNER") else None)
        self.plan.corner, self.plan.frame = heights, None
        if heights == [None] * 4:
            self.plan.frame = self.corner_height((0, 0))

    def corner_height(self, corner):
        return nearest_height(self.known, corner) + self.decide.difference("CORNER_HEIGHT",
                                                                           "CORNER_DOWN")

    def spots(self):
        count = self.decide.number("SPOTS")
        place, places = 0, (self.east - 1) * (self.north - 1)
        for to_come in range(count, 0, -1):
            refuse_if(place >= places)
            run = run_length(places - place, to_come)
            while self.decide.bit("GAP"):
                place += run
                refuse_if(place >= places)
            place += self.decide.one_of(run)
            refuse_if(place >= places)
            spot = 1 + place % (self.east - 1), 1 + place // (self.east - 1)
            height = nearest_height(self.known, spot)
            height += self.decide.difference("SPOT_HEIGHT", "SPOT_DOWN")
            self.add(spot, height)
            self.lines.append(([spot], height))
            place += 1

    def height_q8(self, height):
        if height is None:
            return None
        cell = self.plan.cell
        z = (256 * (height * self.plan.unit + self.cut_off) + cell // 2) // cell
        refuse_if(abs(z) > HIGHEST)
        return z

    def finish(self):
        """In steps and q8."""
        plan = self.plan
        refuse_if(not -(1 << 15) <= plan.base < 1 << 15)
        plan.east, plan.north = self.east * self.spacing, self.north * self.spacing
        plan.lines = [([(x * self.spacing, y * self.spacing) for x, y in line],
                       self.height_q8(height)) for line, height in self.lines]
        plan.corner = [self.height_q8(h) for h in plan.corner]
        plan.frame = self.height_q8(plan.frame)


def read_relief(read, plan, room):
    """Says too whether sections follow. `read` stands behind the relief then."""
    relief = Relief(read, plan, room)
    lines = relief.header()
    relief.all_lines(lines)
    relief.corners()
    relief.spots()
    sections = relief.decide.bit("SECTIONS")
    relief.decide.fill()
    relief.finish()
    read.at -= 1
    plan.seed = read.code[read.at - 1] & 0x7F
    return bool(sections)
