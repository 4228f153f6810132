"""pcrb run, localize and replay: launch files with a master of their own, unless the current one is wanted."""
import csv
import contextlib
import dataclasses
import glob
import json
import os
import shlex
import shutil
import socket
import subprocess

import places
import recipes
from options import Option, did_you_mean, given, one_of
from programs import NotBuilt, launch_options, program, run_program, shared
from words import WORDS

MASTER = Option('master', 'ROS master: one of its own on a free port, or the one at ROS_MASTER_URI',
                choices=('own', 'current'), default='own')
REPEAT = Option('repeat', 'number of trials, for what is not deterministic, each a run in trial_<i>', 'int', low=1, high=1000, default=1)
SWEEP = Option('sweep', 'a run for each value of a parameter of the method', metavar='NAME=V1,V2,...')
JSON = Option('json', 'print the result as JSON and nothing else', 'flag')
OWN_SETTINGS = ('node', 'truth', 'shard', 'autostart', 'required', 'client', 'under-test', 'connect-limit', 'ready-limit', 'loop')
CHOICES = {'restart': ('never', 'target', 'problem'), 'settle': ('first', 'nth', 'stable', 'deadline'),
           'order': ('finished', 'worst', 'best')}


def options_of(file, changes):
    options = []
    for option in launch_options(file):
        if option.name not in OWN_SETTINGS:  # by the launch file's name: --node is its node_launch, --client its client_command
            option = shared(option)
            option = dataclasses.replace(option, choices=CHOICES.get(option.name, option.choices))
            options.append(dataclasses.replace(option, **changes.get(option.name, {})))
    return options


class Benchmark:
    """A run of a launch file's server and client: problems in, a score out."""

    def __init__(self, file, changes, extra=()):
        self.file, self.changes, self.extra = file, changes, extra

    def options(self):
        jobs = dataclasses.replace(WORDS['jobs'], default=1)
        required = {'root': {'required': True}, 'run': {'required': True}}
        return [*options_of(self.file, {**required, **self.changes}), *self.extra, REPEAT, jobs, MASTER, JSON]

    def check(self, values):
        known = [(data_set, sequence) for data_set, sequence, _, _ in places.problem_files(values['root'], values['kind'])]
        if not known:
            return [f'--root: found no problem file below {values["root"]}, expected DATA_SET/SEQUENCE_{values["kind"]}.txt '
                    '(pcrb prepare makes them)']
        _, mistakes = places.select(values['sequences'], known, values['root'])
        return (mistakes + encoding_mistakes(values) + method_mistakes(values) + recipes.mistakes(values.get('node')) +
                master_mistakes(values))

    def arguments(self, options, values):
        always = ('root', 'method')
        never = ('run', 'method') if values.get('client') else ('run',)
        return [assignment(option, values) for option in options
                if option.source and option.name not in never and (option.name in always or given(option, values))]

    def run(self, name, options, values):
        run = os.path.abspath(values['run'])
        status = run_program([program('evaluate_batch'), '--run', run, '--jobs', str(values['jobs']), '--master', values['master'],
                              '--launch', self.file, *series_words(values), *self.arguments(options, values)], f'pcrb {name}',
                             stdout=subprocess.DEVNULL if values['json'] else None)
        if values['json']:
            print(json.dumps({'status': status, **(result_of_series(run) if is_series(values) else result_of(run))}, indent=1))
        elif status == 0:
            shown, report = shlex.quote(values['run']), shlex.quote(values['run'] + '/report')
            if not is_series(values):
                print(f'\nlook at the worst:  pcrb replay --run {shown} --order worst --rviz', end='')
            print(f'\nmake the report:    pcrb report {shown} --output {report}')
        return status


def is_series(values):
    return values['repeat'] > 1 or bool(values.get('sweep'))


def series_words(values):
    """What evaluate_batch is told of a series; nothing where it is one run."""
    words = ['--repeat', str(values['repeat'])] if values['repeat'] > 1 else []
    return words + (['--sweep', values['sweep']] if values.get('sweep') else [])


def result_of_series(run):
    """The results of each run of a series, by its folder."""
    if not os.path.isfile(os.path.join(run, 'series.csv')):
        return {'run': run, 'runs': []}
    with open(os.path.join(run, 'series.csv'), encoding='utf-8', newline='') as file:
        return {'run': run, 'runs': [{**row, **result_of(os.path.join(run, row['folder']))} for row in csv.DictReader(file)]}


def encoding_mistakes(values):
    """What roslaunch is given goes to the ROS master, as XML."""
    shown = {name: os.fsencode(value).decode(errors='replace') for name, value in values.items() if isinstance(value, str)}
    return [f'--{name}: found `{text}`, expected UTF-8: roslaunch takes no other bytes in a path'
            for name, text in shown.items() if text != values[name]]


def method_mistakes(values):
    """A method that nobody has; with a plugin or a client of the user's own any name will do."""
    known = places.known_methods()
    names = [values['method']] if isinstance(values.get('method'), str) else values.get('method') or []
    if values.get('client'):
        return [f'--client and --{other}: found both, expected one of them' for other in ('plugin', 'sweep') if values.get(other)]
    strange = [name for name in names if name not in known]
    plugin = values.get('plugin') or ''
    if os.sep in plugin and not os.path.isfile(plugin):
        return [f'--plugin: found `{plugin}`, expected a file that is there']
    if not plugin:
        return [f'--method: found `{name}`, expected {one_of(known)}, or --plugin or --client with your own{did_you_mean(name, known)}'
                for name in strange]
    return ['--parameters: must be given with a method of your own: ' + WORDS['parameters'].help
            ] if strange and not values['parameters'] else []


def master_mistakes(values):
    if values['master'] == 'own':
        has_node = values.get('node', 'none is needed')
        return [] if has_node else ['--node: must be given: launch file of the node, package and file, or recipe (pcrb recipes)']
    mistakes = ['--repeat, --sweep: found a series, expected one run with --master current'] if is_series(values) else []
    mistakes += [] if values['jobs'] == 1 else ['--jobs: found several, expected 1 with --master current']
    if not has_master():
        uri = os.environ.get('ROS_MASTER_URI')
        mistakes.append(f'--master: found none at {uri}, expected a roscore there, or --master own')
    return mistakes


def assignment(option, values):
    value = values[option.name]
    if isinstance(value, list):
        value = ' '.join(value)
    if option.source == 'node_launch' and recipes.is_recipe(value):
        return f'node:={value}'
    if option.source == 'node_launch' and os.path.isfile(value):
        value = os.path.abspath(value)
    if option.kind == 'flag':
        value = 'true' if value else 'false'
    if option.kind in ('folder', 'file', 'path') and value:
        is_path = option.name != 'plugin' or os.sep in value or os.path.exists(value)  # else the system looks for the library
        value = os.path.abspath(value) if is_path else value
    return f'{option.source}:={value}'


def has_master():
    uri = os.environ.get('ROS_MASTER_URI', 'http://localhost:11311')
    host, _, port = uri.partition('//')[2].rstrip('/').rpartition(':')
    try:
        with socket.create_connection((host, int(port)), timeout=2):
            return True
    except (OSError, ValueError):
        return False


def result_of(run):
    """The summary as numbers, which is there once every problem has its result."""
    summary = os.path.join(run, 'summary.txt')
    is_complete = os.path.isfile(summary)
    result = {'run': run, 'problems': None, 'is_complete': is_complete, 'sequences': []}
    if not is_complete:
        return result
    with open(summary, encoding='utf-8') as file:
        table = file.read().partition('\n\n')[0]  # remarks are below it
    header, *rows = [line.split() for line in table.splitlines()]
    for row in rows:
        result['sequences'].append({name: number_of(text) for name, text in zip(header, row)})
    result['problems'] = sum(row['count'] for row in result['sequences'] if row['sequence'] == 'total')
    return result


def number_of(text):
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return None if text == '-' else text


class Replay:
    """replay.launch with a master of its own. A folder of runs of several methods, as of pcrb paper, takes --method."""

    def options(self):
        options = options_of('replay.launch', {'rviz': {'default': None}, 'problem': {'many': True, 'metavar': 'ID'}, 'kind': {
            'choices': ('local', 'global'), 'shown_default': 'the scans of the sequence, or all of the run'}})
        named = [option for option in options if option.source not in ('sequence', 'sequences')]
        method = dataclasses.replace(WORDS['method'], source='')
        return [dataclasses.replace(WORDS['sequences'], default=None), *named, method, MASTER]

    def check(self, values):
        mistakes = []
        if not values['run'] and len(values['sequences']) != 1:
            mistakes.append('--run or --sequences: expected the folder of a run, or one sequence')
        if values['problem'] and not values['run'] and not values['kind']:
            mistakes.append('--kind: must be given with --problem: a sequence has local and global problems')
        if values['method'] and not values['run']:
            mistakes.append('--method: goes with --run only')
        return mistakes + (self.run_mistakes(values) if values['run'] else [])

    @staticmethod
    def run_mistakes(values):
        folder = run_folder(values)
        if os.path.isfile(os.path.join(folder, 'results.sqlite')):
            return []
        methods = sorted(os.path.basename(os.path.dirname(path)) for path in glob.glob(os.path.join(folder, '*', 'results.sqlite')))
        expected = f'--method {one_of(methods)} beside it' if methods else 'the folder of a run'
        return [f'--run: found no results.sqlite in {folder}, expected {expected}']

    def run(self, name, options, values):
        words = [assignment(option, values) for option in options
                 if option.source and option.name not in ('run', 'rviz') and given(option, values)]
        words.append('rviz:=true' if values['rviz'] else 'rviz:=false')
        sequences = ' '.join(values['sequences'])
        if values['run']:
            words += ['run:=' + os.path.abspath(run_folder(values)), *([f'sequences:={sequences}'] if sequences else [])]
        else:
            words.append(f'sequence:={sequences}')
        with reserved_port() as port:
            own = ['-p', str(port)] if values['master'] == 'own' else []
            return run_program([which('roslaunch'), *own, 'pcrb_launch', 'replay.launch', *words])


def run_folder(values):
    """That of a method's run where one is named."""
    return os.path.join(values['run'], values['method'] or '')


@contextlib.contextmanager
def reserved_port():
    """A port that the system gives to no other process that asks for any. A master, which binds it by its number, gets it."""
    with socket.socket() as holder:
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind(('127.0.0.1', 0))
        yield holder.getsockname()[1]


def which(name):
    path = shutil.which(name)
    if path is None:
        raise NotBuilt(f'found no {name}: install ROS, or source its setup.bash')
    return path
