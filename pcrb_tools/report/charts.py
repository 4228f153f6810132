"""The report's charts, each drawn once from the numbers of report.json: the page and the figures take the same drawing."""
import math

from drawing import RIGHT, TOP, WIDTH, Chart, Drawing, Ink, Linear, Logarithmic, error, interval_text, short, shortened

# Colours that people tell apart who do not see all of them (after Okabe and Ito), each with a contrast of 3 : 1 at least against a
# white and a dark ground; shapes and dashes for those who see none.
COLORS = ['#0072B2', '#D55E00', '#009B70', '#B8659A', '#A87900', '#2E8FC9', '#8C6D31', '#7F7F7F']
SHAPES = ['circle', 'square', 'triangle', 'diamond', 'wedge', 'cross', 'hexagon', 'bow']
DASHES = ['', '9 3', '3 2.5', '9 3 2 3', '6 2', '2 4', '12 4', '5 5']
NEUTRAL = '#74839a'
LONGEST_LABEL = 16  # letters of a method's name within a chart
SMALLEST = 1e-4  # errors below it are drawn there on a logarithmic axis
FEWEST_OF_A_LINE = 5  # problems in each bin that a line joins: between the medians of fewer it would mean nothing

BASELINE = Ink(NEUTRAL, 'bar', '6 4')  # unlike every method's
UNTOUCHED = 'do nothing'  # the baseline, where it is a line of no problem's own


def inks_for(names):
    """How each of some methods, or trackers, is drawn."""
    return {name: Ink(COLORS[i % 8], SHAPES[i % 8], DASHES[(i + i // 8) % 8]) for i, name in enumerate(names)}


def inks_of(section):
    """How the methods are drawn, and the baseline, which is none."""
    inks = inks_for([method['method'] for method in section['methods']])
    return {**inks, **({section['baseline']: BASELINE} if section['baseline'] else {})}


def untouched_of(scores, selection='total'):
    """The median error of the baseline on a selection's problems; None where it is not known."""
    known = [row['median'] for row in scores if row['method'] == UNTOUCHED and row['selection'] == selection]
    return known[0] if known else None


def draw_untouched(chart, value):
    """A line across a chart whose y is the error, at the baseline's."""
    if value is not None and chart.y.low <= value <= chart.y.high:
        chart.curve([(chart.x.low, value), (chart.x.high, value)], BASELINE, method=UNTOUCHED)
        chart.touch(chart.x.high, value, BASELINE.color, f'{UNTOUCHED}: median {error(value)}', UNTOUCHED)


def rows_of(table):
    """The rows of a table of report.json as dictionaries."""
    names = [column['name'] for column in table['columns']]
    return [dict(zip(names, row)) for row in table['rows']]


def floors_of(tables):
    """The accuracy of the ground truth, by sequence, where it is known."""
    rows = rows_of(tables['ground_truth']) if tables.get('ground_truth') else []
    return {row['sequence']: row['floor'] for row in rows if row['floor'] is not None}


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


def median_dots(scores, inks, floors, width=WIDTH):
    """Dots with intervals on a logarithmic axis, a group per sequence."""
    groups = medians_of(scores)
    scale = error_axis([row for rows in groups.values() for row in rows], floors.values())
    height = 40 + sum(26 + 17 * len(rows) for rows in groups.values())
    chart = Drawing(height, 'medians of the error', width)

    def x(value):
        return 10 + (width - 30) * scale(value)
    for tick in scale.ticks(6):
        chart.line((x(tick), 0), (x(tick), height - 34), 'grid')
        chart.text(x(tick), height - 20, short(tick), 'tick')
    chart.text(width / 2, height - 4, 'median error, logarithmic', 'name')
    y = 6
    for name, rows in groups.items():
        chart.text(0, y + 12, name, 'group', 'start')
        y += 18
        if name in floors:
            chart.line((x(floors[name]), y - 2), (x(floors[name]), y + 17 * len(rows)), 'floor',
                       title=f'{name}: floor of the ground truth {error(floors[name])}')
        for row in rows:
            draw_median(chart, row, inks[row['method']], x, y + 7)
            y += 17
        y += 8
    return chart


def draw_median(chart, row, ink, x, y):
    title = (f'{row["method"]}, {row["selection"]}: median {error(row["median"])}, {interval_text(row)}, {row["problems"]} problems in '
             f'{row["pairs"]} pairs')
    if row['low'] is not None:
        chart.line((x(row['low']), y), (x(row['high']), y), 'interval', ink.color, title, row['method'])
    chart.symbol((x(row['median']), y), 5, 'dot', ink, title, row['method'])


def solved_curves(section, inks):
    charts = section['charts']
    thresholds = charts['thresholds']
    chart = Chart(Logarithmic(thresholds[0], thresholds[-1]), Linear(0, 1), 'error threshold', 'fraction solved',
                  label='fraction of problems solved over the error threshold')
    for curve in charts['solved']:
        chart.curve(list(zip(thresholds, curve['fractions'])), inks[curve['method']], method=curve['method'])
    for curve in charts['solved']:
        for threshold, fraction in list(zip(thresholds, curve['fractions']))[::2]:
            chart.touch(threshold, fraction, inks[curve['method']].color,
                        f'{curve["method"]}: {100 * fraction:.1f} % with an error of at most {threshold:.3g}', curve['method'])
    return chart


def swatch(ink):
    """A method's entry in a legend: its line and its mark."""
    drawing = Drawing(14, width=30)
    drawing.polyline([(1, 7), (29, 7)], 'curve', ink.color, dash=ink.dash)
    drawing.symbol((15, 7), 4.8, 'dot', ink)
    return drawing


def binned(panel, inks, x_name, untouched=None):
    """Medians of the error over a property, the quartiles as a band; scans follow one another, so they are always joined, and
    the baseline, which has none, is a line."""
    bins = [b for method in panel['methods'] for b in method['bins']]
    line = [] if untouched is None else [untouched]
    top = max([b['q75'] for b in bins] + line + [10 * SMALLEST])
    low = max(SMALLEST, min([b['q25'] for b in bins] + line))
    chart = Chart(Linear(min(b['low'] for b in bins), max(b['high'] for b in bins)), Logarithmic(low / 1.2, top * 1.2),
                  x_name, 'error', label=f'error over {x_name}, {panel["selection"]}')
    draw_untouched(chart, untouched)
    for method in panel['methods']:
        name, ink = method['method'], inks[method['method']]
        middle = [((b['low'] + b['high']) / 2, b) for b in method['bins']]
        if x_name == 'scan' or all(b['count'] >= FEWEST_OF_A_LINE for b in method['bins']):
            chart.band([(x, b['q25']) for x, b in middle], [(x, b['q75']) for x, b in middle], ink.color, name)
            chart.curve([(x, b['median']) for x, b in middle], ink, method=name)
        for x, b in middle:
            chart.dot(x, b['median'], ink, f'{name}: median {error(b["median"])}, quartiles {error(b["q25"])} '
                      f'to {error(b["q75"])}, {b["count"]} problems with {x_name} {error(b["low"])} to {error(b["high"])}', name)
    return chart


def gaussian(x, mean, deviation):
    return math.exp(-0.5 * ((x - mean) / deviation) ** 2) / (deviation * math.sqrt(2 * math.pi))


def histogram(method, ink, name):
    counts, width = method['counts'], method['max'] / len(method['counts'])
    total = sum(counts) + method['above']
    chart = Chart(Linear(0, method['max']), Linear(0, 1.08 * max(counts + [1]), True), 'error', 'problems', 200,
                  f'histogram of the error, {method["method"]}, {name}')
    for i, count in enumerate(counts):
        if count:
            chart.box((i * width, 0), ((i + 1) * width, count), ink.color,
                      f'{error(i * width)} to {error((i + 1) * width)}: {count} problems ({100 * count / total:.1f} %)')
    if method['stddev']:
        steps = [method['max'] * i / 80 for i in range(81)]
        chart.polyline([chart.at(x, total * width * gaussian(x, method['mean'], method['stddev'])) for x in steps], 'gaussian', None)
    if method['median'] is not None and method['median'] <= method['max']:
        chart.line(chart.at(method['median'], 0), chart.at(method['median'], chart.y.high), 'median',
                   title=f'median {error(method["median"])}')
    if method['above']:
        chart.text(WIDTH - RIGHT, TOP + 10, f'{method["above"]} beyond ▸', 'tick', 'end')
    return chart


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
            chart.box((edges[i], 0), (edges[i + 1], pairs), NEUTRAL, f'overlap {edges[i]:.3f} to {edges[i + 1]:.3f}: {pairs} pairs')
    chart.line(chart.at(panel['median'], 0), chart.at(panel['median'], chart.y.high), 'median',
               title=f'median {panel["median"]:.3f}')
    return chart


def error_over_time(points, inks, untouched=None):
    """Medians of error and time, and the front of the methods that no other one beats in both; a line at the baseline's error."""
    errors = [value for p in points for value in (p['low'], p['median'], p['high'], untouched) if value is not None]
    chart = Chart(Logarithmic(min(p['q05'] for p in points) / 1.5, max(p['q95'] for p in points) * 1.5),
                  Logarithmic(max(SMALLEST, min(errors)) / 1.5, max(SMALLEST, *errors) * 1.5), 's from source to reply', 'median error',
                  label='error against time')
    front = sorted((p for p in points if p['is_front']), key=lambda p: p['time'])
    stairs = []
    for before, after in zip(front, front[1:]):
        stairs += [(before['time'], before['median']), (after['time'], before['median'])]
    stairs += [(front[-1]['time'], front[-1]['median']), (chart.x.high, front[-1]['median'])]
    chart.polyline([chart.at(*p) for p in [(front[0]['time'], chart.y.high), *stairs]], 'front', None)
    draw_untouched(chart, untouched)
    for p in points:
        ink, name = inks[p['method']], p['method']
        title = (f'{name}: median error {error(p["median"])}, median time {error(p["time"])} s (q05 to q95 {error(p["q05"])} to '
                 f'{error(p["q95"])} s)' + (', on the front' if p['is_front'] else ''))
        chart.line(chart.at(p['q05'], p['median']), chart.at(p['q95'], p['median']), 'whisker', ink.color, title, name)
        if p['low'] is not None:
            chart.line(chart.at(p['time'], p['low']), chart.at(p['time'], p['high']), 'whisker', ink.color, title, name)
        chart.dot(p['time'], p['median'], ink, title, name, 5)
        x, y = chart.at(p['time'], p['median'])
        is_right = x > chart.width * 0.75
        chart.text(x + (-8 if is_right else 8), y - 7, shortened(name, LONGEST_LABEL), 'tick', 'end' if is_right else 'start', name)
    return chart


def ranking(numbers, inks):
    """A critical-difference diagram: mean ranks, bars over neighbours that no test tells apart."""
    methods, cliques = numbers['methods'], numbers['cliques']
    count, half = len(methods), (len(methods) + 1) // 2
    left = right = min(190, 68 + 8 * max(len(m['method']) for m in methods))
    axis_y = 36 + 9 * len(cliques)
    chart = Drawing(axis_y + 24 + 20 * half, 'mean ranks of the methods')
    scale = Linear(1, count)

    def x(rank):
        return left + scale(rank) * (WIDTH - left - right)
    chart.line((left, axis_y), (WIDTH - right, axis_y), 'axis')
    for tick in range(1, count + 1):
        chart.line((x(tick), axis_y - 5), (x(tick), axis_y), 'axis')
        chart.text(x(tick), 14, str(tick), 'tick')
    ranks = {m['method']: m['rank'] for m in methods}
    for i, clique in enumerate(cliques):
        y = axis_y - 12 - 9 * (len(cliques) - 1 - i)
        chart.line((x(ranks[clique[0]]) - 4, y), (x(ranks[clique[-1]]) + 4, y), 'clique', title='no difference shown: ' + ', '.join(clique))
    for i, m in enumerate(methods):
        is_left = i < half
        y = axis_y + 22 + 20 * (i if is_left else count - 1 - i)
        end, side = (left - 6, 'end') if is_left else (WIDTH - right + 6, 'start')
        title = f'{m["method"]}: mean rank {m["rank"]:.2f} over {numbers["pairs"]} pairs of clouds'
        chart.polyline([(x(m['rank']), axis_y), (x(m['rank']), y), (end, y)], 'stem', inks[m['method']].color, title, m['method'])
        chart.text(end + (-4 if is_left else 4), y + 4, f'{shortened(m["method"], LONGEST_LABEL)}  {m["rank"]:.2f}', 'label', side, m['method'])
    return chart
