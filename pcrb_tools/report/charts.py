"""The page's charts, each made from the numbers of report.json."""
import math

from svg import (BOTTOM, LEFT, RIGHT, TOP, WIDTH, Chart, Linear, Logarithmic, coordinate, error, escape, interval, short,
                 tip)

# Okabe and Ito's colours, which people tell apart who do not see all of them.
COLORS = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#8C6D31', '#7F7F7F']
NEUTRAL = '#7c8aa0'
SMALLEST = 1e-4  # errors below it are drawn there on a logarithmic axis


def color_of(section):
    """Colours of the methods, and of the baseline, which is none."""
    colors = {method['method']: COLORS[i % len(COLORS)] for i, method in enumerate(section['methods'])}
    return {**colors, **({section['baseline']: NEUTRAL} if section['baseline'] else {})}


def rows_of(table):
    """The rows of a table of report.json as dictionaries."""
    names = [column['name'] for column in table['columns']]
    return [dict(zip(names, row)) for row in table['rows']]


def medians_of(scores):
    """Rows of each sequence and of the total, by name."""
    groups = {}
    for row in scores:
        if row['level'] in ('sequence', 'total'):
            groups.setdefault(row['selection'], []).append(row)
    return groups


def error_axis(rows, floors=()):
    """A logarithmic axis that has all medians and their intervals: errors spread over three decades."""
    values = [row[name] for row in rows for name in ('low', 'median', 'high') if row[name] is not None] + list(floors)
    values = [max(value, SMALLEST) for value in values] or [SMALLEST, 1]
    return Logarithmic(min(values) / 1.4, max(values) * 1.4)


def median_dots(scores, colors, floors):
    """Dots with intervals on a logarithmic axis, a group per sequence. Coordinates along the error are percentages: the
    chart fills any width while the text keeps its size."""
    groups = medians_of(scores)
    scale = error_axis([row for rows in groups.values() for row in rows], floors.values())
    parts, y = [], 6
    for name, rows in groups.items():
        parts.append(f'<text x="0" y="{y + 12}" class="group">{escape(name)}</text>')
        y += 18
        top = y
        for row in rows:
            parts.append(median_dot(row, colors[row['method']], scale, y))
            y += 17
        if name in floors:
            x = coordinate(percent(scale, floors[name]))
            parts.append(f'<line x1="{x}%" x2="{x}%" y1="{top - 2}" y2="{y}" class="floor">'
                         f'{tip(f"{name}: floor of the ground truth {error(floors[name])}")}</line>')
        y += 8
    ticks = ''.join(error_tick(scale, tick, y) for tick in scale.ticks(6))
    return (f'<svg class="bars" width="100%" height="{y + 34}" role="img" aria-label="medians of the error">{ticks}'
            + ''.join(parts) + f'<text x="50%" y="{y + 30}" text-anchor="middle" class="name">median error, logarithmic</text></svg>')


def percent(scale, value):
    return 1 + 97 * scale(value)


def error_tick(scale, tick, y):
    x = coordinate(percent(scale, tick))
    return (f'<line x1="{x}%" x2="{x}%" y1="0" y2="{y}" class="grid"/>'
            f'<text x="{x}%" y="{y + 14}" text-anchor="middle" class="tick">{short(tick)}</text>')


def median_dot(row, color, scale, y):
    title = (f'{row["method"]}, {row["selection"]}: median {error(row["median"])}, '
             + (f'95 % interval {interval(row["low"], row["high"])}' if row['low'] is not None else 'too few pairs for an interval')
             + f', {row["problems"]} problems in {row["pairs"]} pairs')
    text = ''
    if row['low'] is not None:
        a, b = (coordinate(percent(scale, row[side])) for side in ('low', 'high'))
        text = f'<line x1="{a}%" x2="{b}%" y1="{y + 7}" y2="{y + 7}" class="interval" style="stroke:{color}">{tip(title)}</line>'
    return text + (f'<circle cx="{coordinate(percent(scale, row["median"]))}%" cy="{y + 7}" r="5" class="dot" style="fill:{color}">'
                   f'{tip(title)}</circle>')


def solved_curves(section, colors):
    charts = section['charts']
    thresholds = charts['thresholds']
    chart = Chart(Logarithmic(thresholds[0], thresholds[-1]), Linear(0, 1), 'error threshold', 'fraction solved',
                  label='fraction of problems solved over the error threshold')
    for curve in charts['solved']:
        kind = 'curve baseline' if curve['method'] == section['baseline'] else 'curve'
        chart.curve(list(zip(thresholds, curve['fractions'])), colors[curve['method']], kind)
    for curve in charts['solved']:
        for threshold, fraction in list(zip(thresholds, curve['fractions']))[::2]:
            chart.dot(threshold, fraction, colors[curve['method']],
                      f'{curve["method"]}: {100 * fraction:.1f} % with an error of at most {threshold:.3g}', 'touch')
    return chart.svg()


def binned(panel, colors, x_name):
    """Medians of the error over a property, the quartiles as a band."""
    bins = [b for method in panel['methods'] for b in method['bins']]
    top = max(max(b['q75'] for b in bins), 10 * SMALLEST)
    low = max(SMALLEST, min(b['q25'] for b in bins))
    chart = Chart(Linear(min(b['low'] for b in bins), max(b['high'] for b in bins)), Logarithmic(low / 1.2, top * 1.2),
                  x_name, 'error', label=f'error over {x_name}, {panel["selection"]}')
    for method in panel['methods']:
        color = colors[method['method']]
        middle = [((b['low'] + b['high']) / 2, b) for b in method['bins']]
        chart.band([(x, b['q25']) for x, b in middle], [(x, b['q75']) for x, b in middle], color)
        chart.curve([(x, b['median']) for x, b in middle], color)
        for x, b in middle:
            chart.dot(x, b['median'], color, f'{method["method"]}: median {error(b["median"])}, quartiles {error(b["q25"])} '
                      f'to {error(b["q75"])}, {b["count"]} problems with {x_name} {error(b["low"])} to {error(b["high"])}')
    return chart.svg()


def gaussian(x, mean, deviation):
    return math.exp(-0.5 * ((x - mean) / deviation) ** 2) / (deviation * math.sqrt(2 * math.pi))


def histogram(method, color, name):
    counts, width = method['counts'], method['max'] / len(method['counts'])
    total = sum(counts) + method['above']
    chart = Chart(Linear(0, method['max']), Linear(0, 1.08 * max(counts + [1]), True), 'error', 'problems', 200,
                  f'histogram of the error, {method["method"]}, {name}')
    for i, count in enumerate(counts):
        if count:
            chart.box((i * width, 0), ((i + 1) * width, count), color,
                      f'{error(i * width)} to {error((i + 1) * width)}: {count} problems ({100 * count / total:.1f} %)')
    if method['stddev']:
        steps = [method['max'] * i / 80 for i in range(81)]
        chart.curve([(x, total * width * gaussian(x, method['mean'], method['stddev'])) for x in steps],
                    'currentColor', 'gaussian')
    if method['median'] is not None:
        bottom, top = chart.at(method['median'], 0), chart.at(method['median'], chart.y.high)
        chart.line(bottom, top, 'median', title=f'median {error(method["median"])}')
    if method['above']:
        chart.text(WIDTH - RIGHT, TOP + 10, f'{method["above"]} beyond ▸', 'tick', 'end')
    return chart.svg()


def overlap_edges(panel):
    """Ends of the intervals of overlap that the panel's pairs were drawn from."""
    count, width = len(panel['counts']), panel['high'] - panel['low']
    return [panel['low'] + width * i / count for i in range(count + 1)]


def overlaps(panel):
    edges = overlap_edges(panel)
    chart = Chart(Linear(0, 1), Linear(0, 1.08 * max(panel['counts'] + [1]), True), 'overlap', 'pairs', 170,
                  f'overlaps of the pairs, {panel["selection"]}')
    for i, pairs in enumerate(panel['counts']):
        if pairs:
            chart.box((edges[i], 0), (edges[i + 1], pairs), 'var(--neutral)',
                      f'overlap {edges[i]:.3f} to {edges[i + 1]:.3f}: {pairs} pairs')
    chart.line(chart.at(panel['median'], 0), chart.at(panel['median'], chart.y.high), 'median',
               title=f'median {panel["median"]:.3f}')
    return chart.svg()


class Rows(Chart):
    """Horizontal boxes and whiskers, a row each, in place of the y axis."""

    def __init__(self, x, x_name, rows, label):
        self.rows = rows
        left = min(220, max([LEFT, *(12 + 6.6 * len(row['label']) for row in rows)]))  # names are never cut
        super().__init__(x, Linear(0, len(rows)), x_name, '', TOP + BOTTOM + 19 * len(rows), label, left)

    def draw_axes(self, x_name, y_name):
        self.y.ticks = lambda count=0: []
        super().draw_axes(x_name, y_name)
        for i, row in enumerate(self.rows):
            self.text(self.left - 6, self.middle(i) + 4, row['label'], 'tick', 'end')

    def middle(self, i):
        return TOP + 19 * (i + 0.5)

    def mark_cut(self, low, high, y):
        """An arrow with its value for each end of a whisker that leaves the axis."""
        if low < self.x.low:
            self.text(self.left, y + 4, f'◂ {error(low)}', 'beyond', 'start')
        if high > self.x.high:
            self.text(WIDTH - RIGHT, y + 4, f'{error(high)} ▸', 'beyond', 'end')

    def draw(self, whiskers, box, median):
        for i, row in enumerate(self.rows):
            title, color = row['title'], row['color']
            y, level = self.middle(i), len(self.rows) - i - 0.5
            x = [self.at(row[q], 0)[0] for q in whiskers]
            self.line((x[0], y), (x[1], y), 'whisker', color, title)
            self.mark_cut(row[whiskers[0]], row[whiskers[1]], y)
            if box:
                self.box((row[box[0]], level - 0.3), (row[box[1]], level + 0.3), color, title, 'quartiles')
            self.dot(row[median], level, color, title)
        return self.svg()


def components(table, colors, axes, unit):
    rows = []
    for row in rows_of(table):
        if row['selection'] == 'total' and row['axis'] in axes:
            row['label'], row['color'] = row['axis'], colors[row['method']]
            row['title'] = (f'{row["method"]}, {row["axis"]}: median {error(row["median"])} {unit}, q25 to q75 {error(row["q25"])} '
                            f'to {error(row["q75"])}, q05 to q95 {error(row["q05"])} to {error(row["q95"])}')
            rows.append(row)
    rows.sort(key=lambda row: axes.index(row['axis']))
    for before, row in zip(rows, rows[1:]):
        if row['axis'] == before['axis']:
            row['label'] = ''
    widest = max([4 * max(abs(row['q25']), abs(row['q75'])) for row in rows] + [1e-6])
    return Rows(Linear(-widest, widest), f'error in {unit}', rows, f'errors in {unit}').draw(
        ('q05', 'q95'), ('q25', 'q75'), 'median')


def latencies(table, colors):
    rows = []
    for row in rows_of(table):
        if row['selection'] == 'total' and row['median'] is not None:
            row['label'], row['color'] = row['method'], colors[row['method']]
            row['title'] = (f'{row["method"]}: median {1000 * row["median"]:.1f} ms, q05 to q95 {1000 * row["q05"]:.1f} to '
                            f'{1000 * row["q95"]:.1f} ms, max {1000 * row["max"]:.0f} ms, {row["replies"]} replies')
            rows.append(row)
    if not rows:
        return ''
    low, high = min(row['q05'] for row in rows), max(row['q95'] for row in rows)
    return Rows(Logarithmic(max(low, 1e-5) / 1.3, max(high, 2e-5) * 1.3), 's from source to reply', rows, 'latency').draw(
        ('q05', 'q95'), None, 'median')
