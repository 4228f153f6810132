"""What the page's template shows of a section of report.json: charts, and numbers in other arrangements."""
from markupsafe import Markup

import box_charts
import calibration
import charts
import series
from drawing import WIDTH, error, interval

PARTS = [('medians', 'medians'), ('scores', 'scores'), ('differences', 'differences'), ('audit', 'audit'), ('solved', 'solved'),
         ('dependence', 'dependence'), ('distributions', 'distributions'), ('series', 'repeats and sweeps'), ('axes', 'axes'),
         ('covariances', 'covariances'), ('times', 'times'), ('settling', 'settling'), ('overlap', 'overlap'),
         ('sequences', 'sequences'), ('problems', 'worst problems'), ('published', 'published'),
         ('figures', 'figures')]
HEADINGS = {'sequence': 'Sequences', 'data set': 'Data sets', 'group': 'By characteristic', 'total': 'All problems'}


def trusted(text):
    return Markup(text)


def probability(p):
    return '–' if p is None else '< 0.001' if p < 0.001 else f'{p:.3f}'


def cell(value, form):
    if value is None or value == '':
        return '–'
    if form == 'probability':
        return probability(value)
    if form == 'fraction':
        return f'{value:.3f}' if abs(value) >= 0.0005 else error(value)
    if form == 'published':
        return f'{value:.2f}'
    return error(value) if form in ('error', 'seconds') else str(value)


FILTERS = {'error': error, 'cell': cell, 'interval': lambda row: interval(row['low'], row['high']),
           'swatch': lambda ink: svg(charts.swatch(ink))}


def milliseconds(seconds):
    return f'{1000 * seconds:.3g} ms' if seconds < 1 else f'{seconds:.3g} s'


def only_totals(table):
    place = [column['name'] for column in table['columns']].index('selection')
    return {**table, 'rows': [row for row in table['rows'] if row[place] == 'total']}


def cards_of(section, scores):
    latencies = {}
    if 'runtimes' in section['tables']:
        for row in charts.rows_of(section['tables']['runtimes']):
            if row['selection'] == 'total' and row['median'] is not None:
                latencies[row['method']] = milliseconds(row['median'])
    planned = {m['method']: m['planned'] for m in section['methods']}
    for row in scores:
        if row['selection'] == 'total' and row['method'] in planned:
            missing = int(planned[row['method']] or 0) - row['problems'] if section['is_only_kind'] else 0
            yield {**row, 'latency': latencies.get(row['method']), 'missing': max(missing, 0)}


def pivot_of(section, published):
    """The rows of the pivot by level, each with the published medians that may stand beside it."""
    levels = []
    for selection, row in zip(section['selections'], section['pivot']):
        if not levels or levels[-1]['level'] != row['level']:
            levels.append({'level': row['level'], 'heading': HEADINGS[row['level']], 'rows': []})
        levels[-1]['rows'].append({**row, 'shared': shared_of(selection), 'published': [
            published.get((name, selection['published'])) for name in section['published_columns']]})
    return levels


def shared_of(selection):
    """How many of a selection's problems all methods have, where not all have the same ones."""
    if selection['shared'] < selection['problems']:
        return f'{selection["shared"]} of {selection["problems"]} shared'
    return ''


def published_of(section, rows):
    """Published medians by method and row, of those rows that may stand beside a selection."""
    here = {selection['published'] for selection in section['selections']} - {''}
    return {(row['method'], row['sequence']): row['median'] for row in rows if row['sequence'] in here}


def published_columns(published, own):
    """Every method with a published median that is shown, those first that the report itself has."""
    methods = list(dict.fromkeys(method for method, _ in published))
    return [m for m in own if m in methods] + [m for m in methods if m not in own]


def verdicts_of(comparisons):
    """Sentences on the tests over all problems."""
    for row in comparisons:
        if row['selection'] == 'total':
            other = row['b'] if row['better'] == row['a'] else row['a']
            text = f'{row["verdict"]} than {other}' if row['better'] else f'{row["a"]} and {row["b"]}: {row["verdict"]}'
            yield {'text': text, 'real': bool(row['better']), 'p': probability(row['corrected p']), 'pairs': row['pairs']}


def audit_of(section, rows):
    """What the audit section says: of each check, and of the runs that leave something open."""
    runs = [method for method in section['methods'] if method['info']]
    return {'rows': [{**row, 'gains': row['verdict'].startswith('gains')} for row in rows],
            'plain': [m['method'] for m in runs if m['info'].get('audit') != 'true'],
            'live': [m['method'] for m in runs if m['info'].get('results') == 'live']}


def matrix_of(methods, comparisons):
    """What the tests over all problems say of each method (a row) against each other one (a column)."""
    found = {}
    for row in comparisons:
        if row['selection'] == 'total':
            for a, b in ((row['a'], row['b']), (row['b'], row['a'])):
                verdict = ('better' if row['better'] == a else 'worse') if row['better'] else ''
                found[a, b] = {'verdict': verdict, 'p': probability(row['corrected p']), 'pairs': row['pairs'],
                               'text': verdict or ('?' if 'too few' in row['verdict'] else '=')}
    return [{'method': a, 'cells': [None if a == b else found.get((a, b), {'verdict': '', 'text': '–', 'p': '', 'pairs': 0})
                                    for b in methods]} for a in methods]


def svg(drawing, kind=''):
    return trusted(drawing.svg(kind)) if drawing else None


def drawn(panels, draw):
    return [{'name': panel['selection'], 'svg': svg(draw(panel))} for panel in panels]


def dependence_of(section, inks):
    numbers, views = section['charts'], []
    for name, x_name in (('over_misalignment', 'initial misalignment'), ('over_overlap', 'overlap')):
        for chart in drawn(numbers[name], lambda panel, x=x_name: charts.binned(panel, inks, x)):
            views.append({**chart, 'name': f'{chart["name"]}: error over {x_name}'})
    return views


def histograms_of(section, inks):
    views = {'total': [], 'sequences': []}
    for panel in section['charts']['histograms']:
        for method in panel['methods']:
            is_total = panel['selection'] == 'total'
            views['total' if is_total else 'sequences'].append({
                'name': method['method'] if is_total else f'{panel["selection"]}, {method["method"]}',
                'method': method['method'], 'svg': svg(charts.histogram(method, inks[method['method']], panel['selection']))})
    return views


def parts_of(section, figures):
    """What the page's bar of links leads to: the parts that this section has."""
    absent = {part for part, table in (('differences', 'comparisons'), ('audit', 'audit'), ('axes', 'components'),
                                         ('covariances', 'covariances'), ('times', 'runtimes'), ('settling', 'keeping_up'))
              if table not in section['tables']}
    if 'trials' not in section['tables'] and 'sweeps' not in section['tables']:
        absent.add('series')
    if not section['charts']['overlaps']:
        absent.add('overlap')
    if not figures:
        absent.add('figures')
    return [{'id': part, 'name': name} for part, name in PARTS if part not in absent]


def view(section, figures):
    tables, numbers = section['tables'], section['charts']
    for name in ('comparisons', 'audit', 'recall', 'runtimes', 'settling', 'keeping_up', 'components', 'ground_truth', 'covariances',
                 'covariance_axes', 'trials', 'sweeps'):
        tables.setdefault(name, None)
    present = {name: table for name, table in tables.items() if table}
    section['tables'] = present
    inks = charts.inks_of(section)
    own = [method['method'] for method in section['methods']]
    scores = charts.rows_of(present['scores'])
    comparisons = charts.rows_of(present['comparisons']) if 'comparisons' in present else []
    published = published_of(section, charts.rows_of(present['published']))
    section['has_groups'] = any(selection['level'] == 'group' for selection in section['selections'])
    section['own_sequences'] = [s['name'] for s in section['selections']
                                if s['level'] == 'sequence' and set(s['sequences']) & set(section['own_problems'])]
    section['published_columns'] = published_columns(published, own)
    section['has_imports'] = any(not m['info'] for m in section['methods'])
    section['shared'] = next(shared_of(s) for s in section['selections'] if s['level'] == 'total')
    floors = charts.floors_of(present)
    untouched = charts.untouched_of(scores)
    section['is_only_kind'] = all(m['planned'] is None or int(m['planned']) >= m['problems'] for m in section['methods'])
    made = {
        'inks': inks, 'floors': floors, 'parts': parts_of(section, figures),
        'tables': tables, 'figures': figures,
        'cards': list(cards_of(section, scores)),
        'bars': [svg(charts.median_dots(scores, inks, floors, width), kind) for width, kind in ((2 * WIDTH, 'wide'), (WIDTH, 'narrow'))],
        'levels': pivot_of(section, published),
        'verdicts': list(verdicts_of(comparisons)),
        'audit': audit_of(section, charts.rows_of(present['audit'])) if 'audit' in present else None,
        'matrix': matrix_of(list(inks), comparisons) if len(own) > 2 else [],
        'ranking': svg(charts.ranking(numbers['ranking'], inks)) if numbers['ranking'] else None,
        'solved': svg(charts.solved_curves(section, inks)),
        'dependence': dependence_of(section, inks),
        'histograms': histograms_of(section, inks),
        'overlaps': drawn(numbers['overlaps'], charts.overlaps),
        'recall_totals': only_totals(present['recall']) if 'recall' in present else None,
        'runtime_totals': only_totals(present['runtimes']) if 'runtimes' in present else None,
        'over_scans': drawn(numbers['over_scans'], lambda panel: charts.binned(
            panel, inks, 'scan', charts.untouched_of(scores, panel['selection']))),
        'covariance_totals': only_totals(present['covariances']) if 'covariances' in present else None,
        'sweep_charts': [{'name': chart['name'], 'svg': svg(chart['drawing'])} for chart in series.sweeps(present['sweeps'], untouched)]
                        if 'sweeps' in present else [],
        'calibration': svg(calibration.curves(numbers['calibration'], inks)),
        'latencies': svg(box_charts.latencies(present['runtimes'], inks)) if 'runtimes' in present else None,
        'over_time': svg(charts.error_over_time(numbers['times'], inks, untouched)) if numbers['times'] else None,
    }
    if 'components' in present:
        made['translation'] = svg(box_charts.components(present['components'], inks, ['x', 'y', 'z'], 'm'))
        made['rotation'] = svg(box_charts.components(present['components'], inks, ['roll', 'pitch', 'yaw'], 'degrees'))
    return {**section, **made}
