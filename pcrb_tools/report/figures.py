"""The figures in the paper's style, as PNG and PDF, from the numbers in report.json. The same numbers give the same
bytes: the files hold no dates."""
import math
import os

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

import charts  # noqa: E402
from svg import error  # noqa: E402

STYLE = {'font.size': 8, 'axes.titlesize': 8, 'axes.linewidth': 0.6, 'axes.spines.top': False, 'axes.spines.right': False,
         'axes.axisbelow': True, 'axes.grid': True, 'grid.linewidth': 0.4, 'grid.color': '#dddddd', 'legend.frameon': False,
         'figure.constrained_layout.use': True, 'figure.dpi': 200, 'pdf.fonttype': 42, 'svg.hashsalt': 'pcrb'}
COLUMN = 7.16  # inches, both columns of a page


def save(figure, folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    for extension, metadata in (('png', {'Software': None}), ('pdf', {'CreationDate': None, 'Producer': None, 'Creator': None})):
        temporary = folder / f'.{name}.{extension}'
        figure.savefig(temporary, format=extension, metadata=metadata)
        os.replace(temporary, folder / f'{name}.{extension}')
    plt.close(figure)


def grid(count, columns, height):
    """As many axes as panels, in rows; those that stay empty are switched off."""
    columns = min(columns, count)
    rows = math.ceil(count / columns)
    figure, axes = plt.subplots(rows, columns, figsize=(COLUMN * columns / 4 if columns < 4 else COLUMN, height * rows),
                                squeeze=False)
    flat = list(axes.flat)
    for axis in flat[count:]:
        axis.set_axis_off()
    return figure, flat[:count]


def medians(section, colors):
    """Bars of the medians; a bar that is cut off carries its value."""
    scores = [row for row in charts.rows_of(section['tables']['scores']) if row['level'] in ('sequence', 'total')]
    names = list(dict.fromkeys(row['selection'] for row in scores))
    crop = charts.crop_of([row['median'] for row in scores])
    figure, axis = plt.subplots(figsize=(COLUMN, 2.6))
    width = 0.8 / len(colors)
    for i, (method, color) in enumerate(colors.items()):
        rows = {row['selection']: row for row in scores if row['method'] == method}
        for j, name in enumerate(names):
            if name not in rows:
                continue
            x, height = j - 0.4 + (i + 0.5) * width, rows[name]['median']
            is_cut = crop is not None and height > crop
            axis.bar(x, crop if is_cut else height, width, color=color, label=method if name == names[0] else None)
            if is_cut:
                axis.text(x, crop, ' ' + error(height), rotation=90, ha='center', va='bottom', fontsize=6)
    axis.set_xticks(range(len(names)), names, rotation=35, ha='right')
    axis.grid(axis='x', visible=False)
    axis.set_ylabel('median error')
    if crop:
        axis.set_ylim(0, 1.2 * crop)
    handles = [plt.Rectangle((0, 0), 1, 1, color=color) for color in colors.values()]
    axis.legend(handles, colors, ncol=len(colors), loc='upper left', bbox_to_anchor=(0, 1.14))
    return figure


def solved(section, colors):
    figure, axis = plt.subplots(figsize=(COLUMN / 2, 2.4))
    for curve in section['charts']['solved']:
        axis.plot(section['charts']['thresholds'], curve['fractions'], color=colors[curve['method']], label=curve['method'])
    axis.set(xscale='log', xlabel='error threshold', ylabel='fraction solved', ylim=(0, 1.02))
    axis.legend()
    return figure


def binned(panels, colors, x_name):
    figure, axes = grid(len(panels), 4, 1.9)
    for axis, panel in zip(axes, panels):
        for method in panel['methods']:
            color = colors[method['method']]
            x = [(b['low'] + b['high']) / 2 for b in method['bins']]
            low, middle, high = ([max(b[q], charts.SMALLEST) for b in method['bins']] for q in ('q25', 'median', 'q75'))
            axis.fill_between(x, low, high, color=color, alpha=0.15, linewidth=0)
            axis.plot(x, middle, color=color, marker='.', label=method['method'])
        axis.set(yscale='log', title=panel['selection'], xlabel=x_name)
    axes[0].set_ylabel('error')
    axes[0].legend(fontsize=6)
    return figure


def histograms(panels, method, color):
    found = [(panel['selection'], m) for panel in panels for m in panel['methods'] if m['method'] == method]
    figure, axes = grid(len(found), 4, 1.45)
    for axis, (name, histogram) in zip(axes, found):
        counts, width = histogram['counts'], histogram['max'] / len(histogram['counts'])
        axis.bar([(i + 0.5) * width for i in range(len(counts))], counts, width, color=color)
        axis.axvline(histogram['median'], color='black', linewidth=0.8, linestyle='--')
        if histogram['stddev']:
            total = sum(counts) + histogram['above']
            x = [histogram['max'] * i / 100 for i in range(101)]
            axis.plot(x, [total * width * charts.gaussian(v, histogram['mean'], histogram['stddev']) for v in x],
                      color='#444444', linewidth=0.8)
        axis.set(title=name, xlim=(0, histogram['max']))
    figure.supxlabel('error', fontsize=8)
    figure.supylabel('problems', fontsize=8)
    return figure


def overlaps(panels):
    figure, axes = grid(len(panels), 4, 1.4)
    for axis, panel in zip(axes, panels):
        count = len(panel['counts'])
        axis.bar([(i + 0.5) / count for i in range(count)], panel['counts'], 1 / count, color='#7c8aa0')
        axis.set(title=panel['selection'], xlim=(0, 1))
    figure.supxlabel('overlap', fontsize=8)
    figure.supylabel('pairs', fontsize=8)
    return figure


def components(table, colors):
    rows = [row for row in charts.rows_of(table) if row['selection'] == 'total']
    figure, axes = plt.subplots(1, 2, figsize=(COLUMN, 2.2))
    for axis, names, unit in zip(axes, (['x', 'y', 'z'], ['roll', 'pitch', 'yaw']), ('m', 'degrees')):
        shown = sorted((r for r in rows if r['axis'] in names), key=lambda r: names.index(r['axis']))
        boxes = [{'med': r['median'], 'q1': r['q25'], 'q3': r['q75'], 'whislo': r['q05'], 'whishi': r['q95'],
                  'label': r['axis']} for r in shown]
        drawn = axis.bxp(boxes, showfliers=False, patch_artist=True, medianprops={'color': 'black'})
        for patch, row in zip(drawn['boxes'], shown):
            patch.set_facecolor(colors[row['method']])
        axis.set_ylabel(f'error ({unit})')
    return figure


def draw(report, folder):
    with plt.rc_context(STYLE):
        for section in report['sections']:
            draw_section(section, folder)


def draw_section(section, folder):
    kind, numbers, tables = section['kind'], section['charts'], section['tables']
    colors = charts.color_of([method['method'] for method in section['methods']])
    save(medians(section, colors), folder, f'{kind}_medians')
    save(solved(section, colors), folder, f'{kind}_solved')
    for name, x_name in (('over_misalignment', 'initial misalignment'), ('over_overlap', 'overlap')):
        if numbers[name]:
            save(binned(numbers[name], colors, x_name), folder, f'{kind}_{name}')
    for method, color in colors.items():
        save(histograms(numbers['histograms'], method, color), folder, f'{kind}_histograms_{method}')
    if numbers['overlaps']:
        save(overlaps(numbers['overlaps']), folder, f'{kind}_overlaps')
    if tables.get('components'):
        save(components(tables['components'], colors), folder, f'{kind}_components')
