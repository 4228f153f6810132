"""The figures in the paper's style, as PNG and PDF, from the numbers in report.json. The same numbers give the same
bytes: the files hold no dates."""
import math
import os

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

import charts  # noqa: E402

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


def label_all(figure, axes, x_name, y_name):
    """One name for all axes; matplotlib before 3.4 has none of a figure's, there the outer axes take it."""
    if hasattr(figure, 'supxlabel'):
        figure.supxlabel(x_name, fontsize=8)
        figure.supylabel(y_name, fontsize=8)
    else:
        axes[0].set_ylabel(y_name)
        axes[-1].set_xlabel(x_name)


def medians(section, colors):
    """Dots with their intervals on a logarithmic axis."""
    groups = charts.medians_of(charts.rows_of(section['tables']['scores']))
    figure, axis = plt.subplots(figsize=(COLUMN, 2.6))
    for i, (method, color) in enumerate(colors.items()):
        for j, rows in enumerate(groups.values()):
            row = next((row for row in rows if row['method'] == method), None)
            if row is None:
                continue
            x = j - 0.4 + 0.8 * (i + 0.5) / len(colors)
            if row['low'] is not None:
                axis.plot([x, x], [max(row[side], charts.SMALLEST) for side in ('low', 'high')], color=color, linewidth=1)
            axis.plot([x], [max(row['median'], charts.SMALLEST)], color=color, marker='o', markersize=3)
    axis.set_xticks(range(len(groups)))
    axis.set_xticklabels(groups, rotation=35, ha='right')
    axis.grid(axis='x', visible=False)
    axis.set(yscale='log', ylabel='median error')
    axis.legend(handles=handles_of(colors), ncol=len(colors), loc='lower center', bbox_to_anchor=(0.5, 1.0))
    return figure


def handles_of(colors):
    return [plt.Line2D([], [], color=color, marker='o', markersize=3, linewidth=1, label=method) for method, color in colors.items()]


def solved(section, colors):
    figure, axis = plt.subplots(figsize=(COLUMN / 2, 2.4))
    for curve in section['charts']['solved']:
        axis.plot(section['charts']['thresholds'], curve['fractions'], color=colors[curve['method']], label=curve['method'],
                  linestyle='--' if curve['method'] == section['baseline'] else '-')
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
    label_all(figure, axes, 'error', 'problems')
    return figure


def overlaps(panels):
    figure, axes = grid(len(panels), 4, 1.4)
    for axis, panel in zip(axes, panels):
        edges = charts.overlap_edges(panel)
        axis.bar(edges[:-1], panel['counts'], edges[1] - edges[0], align='edge', color='#7c8aa0')
        axis.set(title=panel['selection'], xlim=(0, 1))
    label_all(figure, axes, 'overlap', 'pairs')
    return figure


def components(table, colors):
    rows = [row for row in charts.rows_of(table) if row['selection'] == 'total']
    figure, axes = plt.subplots(1, 2, figsize=(COLUMN, 2.2))
    for axis, names, unit in zip(axes, (['x', 'y', 'z'], ['roll', 'pitch', 'yaw']), ('m', 'degrees')):
        shown = sorted((r for r in rows if r['axis'] in names), key=lambda r: names.index(r['axis']))
        boxes = [{'med': r['median'], 'q1': r['q25'], 'q3': r['q75'], 'whislo': r['q05'], 'whishi': r['q95']} for r in shown]
        drawn = axis.bxp(boxes, showfliers=False, patch_artist=True, medianprops={'color': 'black'})
        groups = [[i + 1 for i, r in enumerate(shown) if r['axis'] == name] for name in names]
        axis.set_xticks([sum(group) / len(group) for group in groups if group])
        axis.set_xticklabels([n for n, group in zip(names, groups) if group])
        for patch, row in zip(drawn['boxes'], shown):
            patch.set_facecolor(colors[row['method']])
        axis.set_ylabel(f'error ({unit})')
    figure.suptitle(' ')  # keeps room for the legend, which the layout does not see
    figure.legend(handles=handles_of({row['method']: colors[row['method']] for row in rows}), ncol=4, loc='upper center')
    return figure


def draw(report, folder):
    with plt.rc_context(STYLE):
        for section in report['sections']:
            draw_section(section, folder)


def draw_section(section, folder):
    kind, numbers, tables = section['kind'], section['charts'], section['tables']
    colors = charts.color_of(section)
    save(medians(section, colors), folder, f'{kind}_medians')
    save(solved(section, colors), folder, f'{kind}_solved')
    for name, x_name in (('over_misalignment', 'initial misalignment'), ('over_overlap', 'overlap'), ('over_scans', 'scan')):
        if numbers[name]:
            save(binned(numbers[name], colors, x_name), folder, f'{kind}_{name}')
    for method in section['methods']:
        name = method['method']
        save(histograms(numbers['histograms'], name, colors[name]), folder, f'{kind}_histograms_{name}')
    if numbers['overlaps']:
        save(overlaps(numbers['overlaps']), folder, f'{kind}_overlaps')
    if tables.get('components'):
        save(components(tables['components'], colors), folder, f'{kind}_components')
