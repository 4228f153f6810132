"""pcrb run, localize and replay: launch files with a master of their own, unless the current one is wanted."""
import contextlib
import csv
import dataclasses
import json
import os
import shlex
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from xml.sax.saxutils import quoteattr

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
OWN_SETTINGS = ('node', 'shard', 'autostart', 'required', 'client', 'under-test', 'connect-limit', 'ready-limit', 'loop')
CHOICES = {'restart': ('never', 'target', 'problem'), 'settle': ('first', 'nth', 'stable', 'deadline'),
           'order': ('finished', 'worst', 'best')}


def options_of(file, changes):
    options = []
    for option in launch_options(file):
        option = shared(option)
        if option.name not in OWN_SETTINGS:
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
        always = ('root', 'time-limit')
        return [assignment(option, values) for option in options
                if option.source and option.name != 'run' and (option.name in always or given(option, values))]

    def run(self, name, options, values):
        run = os.path.abspath(values['run'])
        os.makedirs(run, exist_ok=True)
        with launch_of(self.file, values) as (file, changed):
            arguments = [word for word in self.arguments(options, values) if not word.startswith(changed)]
            how = run_with_current_master if values['master'] == 'current' else run_with_own_master
            status = how(name, file, arguments, run, values)
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


def result_of_series(run):
    """The results of each run of a series, by its folder."""
    with open(os.path.join(run, 'series.csv'), encoding='utf-8', newline='') as file:
        return {'run': run, 'runs': [{**row, **result_of(os.path.join(run, row['folder']))} for row in csv.DictReader(file)]}


def encoding_mistakes(values):
    """What roslaunch is given goes to the ROS master, as XML."""
    shown = {name: os.fsencode(value).decode(errors='replace') for name, value in values.items() if isinstance(value, str)}
    return [f'--{name}: found `{text}`, expected UTF-8: roslaunch takes no other bytes in a path'
            for name, text in shown.items() if text != values[name]]


def method_mistakes(values):
    methods, method = places.known_methods(), values.get('method')
    if not method or values.get('client') or method in methods:
        return []
    if not values['plugin']:
        return [f'--method: found `{method}`, expected {one_of(methods)}, or --plugin with your own' + did_you_mean(method, methods)]
    return [] if values['parameters'] else [
        '--parameters: must be given with a method of your own: ' + WORDS['parameters'].help]


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
        value = os.path.abspath(value) if os.sep in value or option.name != 'plugin' else value
    return f'{option.source}:={value}'


CLIENT_LAUNCH = '''<launch>
  <arg name="run"/> <arg name="root"/> <arg name="sequences" default="all"/> <arg name="kind" default="local"/>
  <arg name="presentation" default="registration"/> <arg name="subset" default="0"/> <arg name="seed" default="1"/>
  <arg name="shard" default="0/1"/> <arg name="time_limit" default="10"/> <arg name="rviz" default="false"/>
  <arg name="audit" default="false"/> <arg name="results" default="$(eval 'live' if arg('rviz') else 'end')"/>
  <arg name="yaw_only" default="false"/> <arg name="global_guess" default="false"/>
  <include file="$(find pcrb_launch)/benchmark.launch" pass_all_args="true">
    <arg name="client" value="false"/>
    <arg name="under_test" value={name}/>
  </include>
  <node ns="/pcrb" name="client" pkg="pcrb_tools" type="run_command" args={args} output="screen"/>
</launch>
'''


@contextlib.contextmanager
def launch_of(file, values):
    """The launch file, and beginnings of arguments that it does not take: one that starts --client where that is given.

    It lies in the run's folder, under a name that says nothing of the moment: an interrupted run goes on with it.
    """
    if not values.get('client'):
        yield file, ()
        return
    path = os.path.join(os.path.abspath(values['run']), 'client.launch')
    command = shlex.join(['sh', '-c', values['client']])
    with open(path, 'w', encoding='utf-8') as out:
        out.write(CLIENT_LAUNCH.format(name=quoteattr(values['client']), args=quoteattr(command)))
    yield path, ('client:=', 'method:=', 'plugin:=', 'parameters:=')


def run_with_own_master(name, file, arguments, run, values):
    series = ['--repeat', str(values['repeat']), *(['--sweep', values['sweep']] if values.get('sweep') else [])]
    command = [program('evaluate_batch'), '--run', run, '--jobs', str(values['jobs']), '--launch', file,
               *(series if is_series(values) else []), *arguments]
    return run_program(command, f'pcrb {name}', stdout=subprocess.DEVNULL if values['json'] else None)


def run_with_current_master(name, file, arguments, run, values):
    command = ['roslaunch', *([] if os.sep in file else ['pcrb_launch']), file, f'run:={run}', *arguments]
    log = os.path.join(run, 'roslaunch.log')
    with open(log, 'a', encoding='utf-8') as out, subprocess.Popen(command, stdout=out, stderr=out) as process:
        watch(process, run)
    summary = os.path.join(run, 'summary.txt')
    if not os.path.isfile(summary) or not is_complete(run):
        print(f'pcrb {name}: the run is not complete, its log is {log}', file=sys.stderr)
        return 1
    if not values['json']:
        with open(summary, encoding='utf-8') as file:
            print(file.read(), end='')
    return 0


def watch(process, run):
    """Shows how many results there are until the process has ended."""
    is_terminal = sys.stderr.isatty()
    while process.poll() is None:
        try:
            time.sleep(0.5)
            if is_terminal:
                print(f'\r{count_of(run)} problems have a result ', end='', file=sys.stderr, flush=True)
        except KeyboardInterrupt:
            process.send_signal(signal.SIGINT)
    if is_terminal:
        print(file=sys.stderr)


def has_master():
    uri = os.environ.get('ROS_MASTER_URI', 'http://localhost:11311')
    host, _, port = uri.partition('//')[2].rstrip('/').rpartition(':')
    try:
        with socket.create_connection((host, int(port)), timeout=2):
            return True
    except (OSError, ValueError):
        return False


def query(run, text):
    path = os.path.join(run, 'results.sqlite')
    if not os.path.isfile(path):
        return []
    with contextlib.closing(sqlite3.connect(f'file:{path}?mode=ro', uri=True)) as store:
        try:
            return store.execute(text).fetchall()
        except sqlite3.Error:
            return []


def count_of(run):
    return (query(run, 'SELECT COUNT(*) FROM result') or [(0,)])[0][0]


def is_complete(run):
    planned = query(run, "SELECT value FROM run WHERE key = 'problems'")
    return bool(planned) and str(planned[0][0]) == str(count_of(run))


def result_of(run):
    """The summary as numbers."""
    result = {'run': run, 'problems': count_of(run), 'is_complete': is_complete(run), 'sequences': []}
    summary = os.path.join(run, 'summary.txt')
    if not os.path.isfile(summary):
        return result
    with open(summary, encoding='utf-8') as file:
        table = file.read().partition('\n\n')[0]  # remarks are below it
    header, *rows = [line.split() for line in table.splitlines()]
    for row in rows:
        result['sequences'].append({name: number_of(text) for name, text in zip(header, row)})
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
    """replay.launch with a master of its own."""

    def options(self):
        options = options_of('replay.launch', {'rviz': {'default': None}, 'kind': {
            'choices': ('local', 'global'), 'shown_default': 'the scans of the sequence'}, 'name': {
                'name': 'sequences', 'help': WORDS['sequences'].help}})
        return [*options, MASTER]

    def check(self, values):
        mistakes = []
        if bool(values['run']) == bool(values['sequences']):
            mistakes.append('--run or --sequences: expected one of the two')
        if values['run'] and not os.path.isfile(os.path.join(values['run'], 'results.sqlite')):
            mistakes.append(f'--run: found no results.sqlite in {values["run"]}, expected the folder of a run')
        return mistakes

    def run(self, name, options, values):
        words = [assignment(option, values) for option in options if option.source and given(option, values)]
        words += ['rviz:=true' if values['rviz'] else 'rviz:=false'] if not any(w.startswith('rviz:=') for w in words) else []
        own = ['-p', str(free_port())] if values['master'] == 'own' else []
        return run_program([which('roslaunch'), *own, 'pcrb_launch', 'replay.launch', *words])


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def which(name):
    path = shutil.which(name)
    if path is None:
        raise NotBuilt(f'found no {name}: install ROS, or source its setup.bash')
    return path
