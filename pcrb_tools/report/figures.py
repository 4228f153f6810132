"""The page's charts as PNG and PDF for a paper, with legends and captions: the same drawings, put on paper by matplotlib. The same
numbers give the same bytes: the files hold no dates."""
import os

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)
from matplotlib.collections import PolyCollection  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patches import Circle, Polygon  # noqa: E402

import box_charts  # noqa: E402
import calibration  # noqa: E402
import charts  # noqa: E402
import series  # noqa: E402
import tracking  # noqa: E402
from drawing import WIDTH, Drawing, shortened  # noqa: E402

POINTS = 7.16 / (2 * WIDTH) * 72  # per unit: two charts are as wide as both columns of a page, 7.16 inches
INK, SOFT, RULE = '#1d2430', '#4a5360', '#dde2e9'
# What page.css says of these classes: colour, width in units, dash, opacity, size of letters.
STYLE = {'grid': {'color': RULE, 'width': 1}, 'axis': {'color': SOFT, 'width': 1}, 'whisker': {'width': 1.6}, 'interval': {'width': 2.6,
         'alpha': 0.6}, 'floor': {'color': '#c0392b', 'width': 2}, 'median': {'color': INK, 'width': 1.8, 'dash': '5 3'},
         'curve': {'width': 2.2}, 'gaussian': {'color': INK, 'width': 1.4}, 'front': {'color': SOFT, 'width': 1.4, 'dash': '5 4'},
         'band': {'alpha': 0.13}, 'quartiles': {'alpha': 0.55}, 'clique': {'color': INK, 'width': 5}, 'stem': {'width': 1.6},
         'ground': {'color': SOFT, 'alpha': 0.45}}
LETTERS = {'tick': 13, 'name': 14, 'group': 14, 'beyond': 12, 'title': 15, 'label': 14}


def put(axes, name, points, style, zorder):
    """A mark on axes that are the drawing's units, y downwards."""
    kind = STYLE.get(style['kind'], {})
    color = style.get('color') or kind.get('color', INK)
    if name in ('line', 'polyline'):
        dash = style.get('dash') or kind.get('dash')
        pattern = (0, [float(part) / kind.get('width', 1.5) for part in dash.split()]) if dash else '-'
        axes.add_line(Line2D(*zip(*points), color=color, linewidth=POINTS * kind.get('width', 1.5), alpha=kind.get('alpha'),
                             linestyle=pattern, solid_capstyle='round', solid_joinstyle='round', zorder=zorder))
    elif name == 'polygon':
        axes.add_patch(Polygon(points, closed=True, facecolor=color, edgecolor='none', alpha=kind.get('alpha'), zorder=zorder))
    elif name == 'squares':
        squares = [[(x, y), (x + style['size'], y), (x + style['size'], y + style['size']), (x, y + style['size'])] for x, y in points]
        axes.add_collection(PolyCollection(squares, facecolor=color, edgecolor='none', alpha=kind.get('alpha'), zorder=zorder))
    elif name == 'circle':
        axes.add_patch(Circle(points[0], style['radius'], facecolor=color, edgecolor='none', zorder=zorder))
    else:
        axes.text(*points[0], style['text'], size=POINTS * LETTERS.get(style['kind'], 13), color=INK if style['kind'] != 'tick' else SOFT,
                  ha={'start': 'left', 'middle': 'center', 'end': 'right'}[style['anchor']], va='baseline',
                  rotation=90 if style['upright'] else 0, weight='bold' if style['kind'] in ('group', 'title') else 'normal', zorder=zorder)


def save(drawing, folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    figure = plt.figure(figsize=(drawing.width * POINTS / 72, drawing.height * POINTS / 72))
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set_axis_off()
    axes.set(xlim=(0, drawing.width), ylim=(drawing.height, 0))
    for zorder, mark in enumerate(drawing.marks):  # later marks lie on earlier ones, whatever they are
        if mark[2]['kind'] != 'touch':
            put(axes, *mark, zorder)
    for extension, metadata in (('png', {'Software': None}), ('pdf', {'CreationDate': None, 'Producer': None, 'Creator': None})):
        temporary = folder / f'.{name}.{extension}'
        figure.savefig(temporary, format=extension, metadata=metadata)
        os.replace(temporary, folder / f'{name}.{extension}')
    plt.close(figure)


def legend(inks, width):
    """Rows of a swatch and a name."""
    x, y, places = 8, 16, []
    for method, ink in inks.items():
        method = shortened(method, int((width - 64) / 9))
        size = 48 + 9 * len(method)
        if x > 8 and x + size > width:
            x, y = 8, y + 22
        places.append((x, y, method, ink))
        x += size
    drawing = Drawing(y + 12, width=width)
    for x, y, method, ink in places:
        drawing.include(charts.swatch(ink), x, y - 12)
        drawing.text(x + 36, y, method, 'label', 'start')
    return drawing


def sheet(panels, inks=None, columns=2):
    """Drawings with their titles (name or empty) beside and below each other, a legend above."""
    columns = min(columns, len(panels))
    width = max(drawing.width for _, drawing in panels)
    top = legend(inks, columns * width) if inks else None
    gap = 24 if any(name for name, _ in panels) else 4
    rows = [panels[i:i + columns] for i in range(0, len(panels), columns)]
    height = (top.height if top else 0) + sum(gap + max(drawing.height for _, drawing in row) for row in rows)
    whole = Drawing(height, width=columns * width)
    y = 0
    if top:
        whole.include(top, 0, 0)
        y = top.height
    for row in rows:
        for i, (name, drawing) in enumerate(row):
            if name:
                whole.text(i * width + width / 2, y + 16, name, 'title')
            whole.include(drawing, i * width, y + gap)
        y += gap + max(drawing.height for _, drawing in row)
    return whole


def figures_of(section):
    """(name, drawing, caption) of each figure of a section."""
    kind, numbers, tables, inks = section['kind'], section['charts'], section['tables'], charts.inks_of(section)
    methods = {name: ink for name, ink in inks.items() if name != section['baseline']}
    are_cut = any(shortened(name, charts.LONGEST_LABEL) != name for name in methods)
    scores = charts.rows_of(tables['scores'])
    untouched = charts.untouched_of(scores)
    floors = charts.floors_of(tables)
    yield ('medians', sheet([('', charts.median_dots(scores, inks, floors, 2 * WIDTH))], inks),
           f'Median error of the {kind} problems of each sequence, with 95 % bootstrap intervals over pairs of clouds.'
           + (' Grey: the error of the initial guesses.' if section['baseline'] else '')
           + (' Red: the accuracy of the ground truth.' if floors else ''))
    yield ('solved', sheet([('', charts.solved_curves(section, inks))], inks),
           f'Fraction of the {kind} problems that are solved, over the error up to which one counts as solved.')
    for name, x_name in (('over_misalignment', 'initial misalignment'), ('over_overlap', 'overlap'), ('over_scans', 'scan')):
        if numbers[name]:
            yield (name, sheet([(p['selection'], charts.binned(p, inks, x_name, charts.untouched_of(scores, p['selection'])
                                                               if name == 'over_scans' else None)) for p in numbers[name]], inks),
                   f'Error over the {x_name}, {kind} problems: '
                   + ('medians and quartiles; a problem that ended before keeps its last answer.' if name == 'over_scans' else
                      'medians of bins that hold equally many problems; joined, with their quartiles, where each bin holds at least '
                      f'{charts.FEWEST_OF_A_LINE}.'))
    for described in section['methods']:
        method = described['method']
        panels = [(p['selection'], charts.histogram(m, inks[method], p['selection'])) for p in numbers['histograms'] for m in p['methods']
                  if m['method'] == method]
        yield ('histograms_' + described['figure'], sheet(panels),
               f'Errors of {method} on the {kind} problems. Dashed: the median; curve: the normal distribution of the same mean and '
               'standard deviation.')
    if numbers['overlaps']:
        yield ('overlaps', sheet([(p['selection'], charts.overlaps(p)) for p in numbers['overlaps']]),
               f'Overlap of the pairs of clouds of the {kind} problems. Dashed: the median.')
    if tables.get('components'):
        yield ('components', sheet([('translation', box_charts.components(tables['components'], inks, ['x', 'y', 'z'], 'm')),
                                    ('rotation', box_charts.components(tables['components'], inks, ['roll', 'pitch', 'yaw'], 'degrees'))],
                                   inks), f'Errors along and about each axis, answered {kind} problems: median, quartiles, and the '
               'quantiles 0.05 to 0.95.')
    swept = series.sweeps(tables['sweeps'], untouched) if tables.get('sweeps') else []
    if swept:
        yield ('sweeps', sheet([(chart['name'], chart['drawing']) for chart in swept]),
               f'Median error over the values of a parameter, {kind} problems, with 95 % bootstrap intervals over pairs of clouds.')
    calibrated = calibration.curves(numbers['calibration'], inks)
    if calibrated:
        yield ('calibration', sheet([('', calibrated)], {curve['method']: inks[curve['method']] for curve in numbers['calibration']['curves']}),
               f'Fraction of the errors that lie in the ellipsoid of each probability, {kind} problems. Dashed: right covariances; a '
               'curve below says too little (overconfident), one above too much.')
    latency = box_charts.latencies(tables['runtimes'], inks) if tables.get('runtimes') else None
    if latency:
        yield ('latencies', sheet([('', latency)]), f'Time from a source to its reply, {kind} problems: median, quantiles 0.05 to 0.95.')
    if numbers['times']:
        yield ('times', sheet([('', charts.error_over_time(numbers['times'], inks, untouched))], methods if are_cut else None),
               f'Median error against median time to a reply, {kind} problems. Dashed: the front of the methods that no other one beats '
               'in both.')
    if numbers['ranking']:
        yield ('ranking', sheet([('', charts.ranking(numbers['ranking'], inks))], methods if are_cut else None),
               f'Mean ranks over {numbers["ranking"]["pairs"]} pairs of clouds, {kind} problems. Bars join methods between which '
               "Wilcoxon's signed-rank test shows no difference after Holm's correction.")


ENVIRONMENT = '''\\begin{figure}[p]
\\centering
\\includegraphics[width=%s\\linewidth,height=0.85\\textheight,keepaspectratio]{figures/%s.pdf}
\\caption{%s}
\\label{fig:pcrb-%s}
\\end{figure}
\\clearpage

'''


def latex(text, rules):
    """A text as LaTeX reads it, by the report's rules; letters that its usual fonts lack are `?`. Long words may be broken."""
    def letter(c):
        return rules['letters'].get(c, c if any(first <= c <= last for first, last in rules['ranges']) else '?')

    def broken(word):
        pieces = (word[i:i + rules['unbroken']] for i in range(0, len(word), rules['unbroken']))
        return '\\hspace{0pt}'.join(''.join(map(letter, piece)) for piece in pieces)
    return ' '.join(map(broken, text.split(' ')))


def figures_of_trackers(trackers):
    """The same for trackers."""
    for number, group in enumerate(tracking.view(trackers)['groups'], 1):
        yield (f'paths_{number}', sheet([('', group['paths'])], group['inks']),
               'Trajectories over the map of the scans, from above. Grey and dashed: the truth.')
        yield (f'errors_{number}', sheet([('', group['errors'])], group['inks']),
               "The benchmark's error of each scan over time. At the bottom: scans at which the tracker was lost.")


def draw(report, folder):
    """All figures, and figures.tex with a caption for each; their names and captions by kind, those of trackers by `tracking`."""
    parts = [(section['kind'], figures_of(section)) for section in report['sections']]
    if report['trackers']:
        parts.append(('tracking', figures_of_trackers(report['trackers'])))
    text, listed = '% All figures, each to be cut out, or all by \\input\n% \\usepackage{graphicx}\n\n', {}
    with plt.rc_context({'pdf.fonttype': 42, 'figure.dpi': 200, 'savefig.dpi': 200}):
        for kind, figures in parts:
            for name, drawing, caption in figures:
                name = f'{kind}_{name}'
                save(drawing, folder / 'figures', name)
                text += ENVIRONMENT % ('' if drawing.width > WIDTH else '0.6', name, latex(caption, report['latex']), name.replace('_', '-'))
                listed.setdefault(kind, []).append((name, caption))
    return text, listed
