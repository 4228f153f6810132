"""pcrb compare OLD NEW: how two runs differ, as text, with a verdict for continuous integration."""
import json
import math
import os
import subprocess
import tempfile

from options import Option, UsageError
from programs import program, run_program

TOO_FEW = 'too few pairs to tell'  # the report's verdict

OPTIONS = [
    Option('old', 'folder of the run to compare with', 'folder', 'OLD', positional=True, required=True),
    Option('new', 'folder of the run that is compared', 'folder', 'NEW', positional=True, required=True),
    Option('max-increase', 'largest increase of a median error that passes, in percent', 'number', low=0, default=5.0),
    Option('significance', 'corrected p below which a difference counts as shown', 'number', low=0, high=1, default=0.05),
    Option('json', 'print the result as JSON and nothing else', 'flag'),
]


def check(values):
    return [f'{name.upper()}: found no results.sqlite in {values[name]}, expected the folder of a run'
            for name in ('old', 'new') if not os.path.isfile(os.path.join(values[name], 'results.sqlite'))]


def run(name, options, values):
    with tempfile.TemporaryDirectory(prefix='pcrb_compare') as folder:
        status = run_program([program('report'), f'old={values["old"]}', f'new={values["new"]}', '--output', folder,
                              '--no-components', '--no-figures'], f'pcrb {name}', stdout=subprocess.DEVNULL)
        if status != 0:
            return status
        with open(os.path.join(folder, 'report.json'), encoding='utf-8') as file:
            rows = [row for section in json.load(file)['sections'] for row in differences(section)]
    if not rows:
        raise UsageError([f'found no problem that both {values["old"]} and {values["new"]} have'])
    judged = [{**row, 'verdict': verdict(row, values)} for row in rows]
    if values['json']:
        print(json.dumps(judged, indent=1))
    else:
        print_table(judged)
    worse = [row for row in judged if row['verdict'] == 'worse']
    return 1 if worse else 0


def differences(section):
    """Rows of both runs' medians and of the test of their difference, where both have a sequence."""
    def rows_of(table):
        names = [column['name'] for column in table['columns']]
        return [dict(zip(names, row)) for row in table['rows']]
    medians = {(row['method'], row['selection']): row for row in rows_of(section['tables']['scores'])
               if row['level'] in ('sequence', 'total')}
    for row in rows_of(section['tables'].get('comparisons', {'columns': [], 'rows': []})):
        if (row['a'], row['b']) != ('old', 'new'):
            continue  # one of them against doing nothing
        old, new = (medians[method, row['selection']] for method in ('old', 'new'))
        yield {'sequence': row['selection'], 'kind': section['kind'], 'problems': row['problems'], 'pairs': row['pairs'],
               'old': old['median'], 'new': new['median'], 'difference': new['median'] - old['median'],
               'unanswered_old': old['problems'] - old['replied'], 'unanswered_new': new['problems'] - new['replied'],
               'p': row['corrected p'], 'test': row['verdict']}


def verdict(row, values):
    """worse and better: the test shows the difference, and the median has moved by more than the threshold; a problem that
    is not answered any more is worse without a test."""
    if row['unanswered_new'] > row['unanswered_old']:
        return 'worse'
    if row['test'] == TOO_FEW:
        return TOO_FEW
    limit = values['max-increase'] / 100 * row['old']
    if row['p'] is None or row['p'] >= values['significance'] or abs(row['difference']) <= limit:
        return 'same'
    return 'worse' if row['difference'] > 0 else 'better'


def three_digits(value):
    """Three significant digits, never 0.000 for what is not 0."""
    if value is None:
        return '-'
    if value == 0:
        return '0'
    if abs(value) < 1e-3 or abs(value) >= 1e5:
        return f'{value:.2e}'
    decimals = max(0, 2 - math.floor(math.log10(abs(value))))
    return f'{value:.{decimals}f}'


def print_table(rows):
    header = ['sequence', 'kind', 'problems', 'unanswered', 'old', 'new', 'Δ', 'Δ %', 'p', '']
    lines = [header]
    for row in rows:
        percent = f'{100 * row["difference"] / row["old"]:+.1f}' if row['old'] else '-'
        lines.append([row['sequence'], row['kind'], str(row['problems']), f'{row["unanswered_old"]} > {row["unanswered_new"]}',
                      three_digits(row['old']), three_digits(row['new']), ('+' if row['difference'] > 0 else '') +
                      three_digits(row['difference']), percent, '-' if row['p'] is None else f'{row["p"]:.3g}', row['verdict']])
    widths = [max(len(line[i]) for line in lines) for i in range(len(header))]
    for line in lines:
        cells = [text.ljust(width) if i < 2 or i == len(header) - 1 else text.rjust(width)
                 for i, (text, width) in enumerate(zip(line, widths))]
        print('  '.join(cells).rstrip())
    if any(row['verdict'] == TOO_FEW for row in rows):
        print('A test of so few pairs of clouds (fewer than 6, or a few more in several sequences) can show no difference: whether '
              'these are the same or worse is not known.')
