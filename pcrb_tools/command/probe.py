"""pcrb probe: starts a localization node, looks at what it takes and says, and prints the recipe that fits.

A robot (probe_robot) gives it one map, one initial pose and ten scans of a made-up room (probe_room), and notes what it says; probe_recipe
judges that.
"""
import contextlib
import dataclasses
import os
import re
import shlex
import subprocess
import sys
import tempfile

import probe_recipe
import recipes
from benchmarking import reserved_port, which
from options import Option
from programs import NotBuilt, program
from words import WORDS

OPTIONS = [
    dataclasses.replace(WORDS['node'], required=True),
    Option('node-args', 'arguments of the node\'s launch file, name=value, separated by blanks'),
    Option('map-topic', 'where the node takes its map', shown_default='found out'),
    Option('scan-topic', 'where the node takes its scans', shown_default='found out'),
    Option('pose-topic', 'where the node publishes its pose; tf: it does so on tf', shown_default='found out'),
    Option('map-file', 'file that the node reads its map from when it starts', 'path', 'FILE'),
    Option('start-limit', 'seconds that the node may take to start', 'number', default=60, low=1),
    Option('output', 'file or folder to write', 'path', short='o'),
]

PATIENCE = 45  # s, longer than that of guard_launch


def check(values):
    return recipes.mistakes(values['node'])


def run(name, options, values):
    with contextlib.ExitStack() as stack:
        environment = start_master(stack)
        os.environ.update(environment)
        robot = make_robot(values)  # imports ROS, which reads the environment
        robot.write_map()  # before the node starts, which may read it then
        log = stack.enter_context(tempfile.NamedTemporaryFile('w+', suffix='.log'))
        node = start(stack, ['roslaunch', '--wait', *launch_words(values)], log)
        observation = robot.probe(lambda: node.poll() is None)
        if observation is None:
            print(f'pcrb {name}: the node\'s launch file ended, or no node takes point clouds after {values["start-limit"]} s; '
                  f'it printed:\n{tail_of(log.name)}', file=sys.stderr)
            return 1
    recipe = probe_recipe.judge(observation)
    words = shlex.quote(values['node']) + (f' --node-args {shlex.quote(values["node-args"])}' if values['node-args'] else '')
    text = probe_recipe.text_of(recipe, words, values['output'] or 'FILE')
    print(text, end='')
    if values['output']:
        with open(values['output'], 'w', encoding='utf-8') as file:
            file.write(text)
    return 0 if recipe.is_answered else 1


def make_robot(values):
    try:
        import probe_robot
    except ImportError as error:
        raise NotBuilt(f'found no {error.name}: source the setup.bash of a ROS workspace') from error
    return probe_robot.Robot(probe_robot.Hints(map_topic=values['map-topic'], scan_topic=values['scan-topic'],
                                               pose_topic=values['pose-topic'], map_file=map_file_of(values),
                                               start_limit=values['start-limit']))


def map_file_of(values):
    """Of a known node, the file that its recipe names: which one a node reads cannot be seen."""
    if values['map-file'] or not recipes.is_recipe(values['node']):
        return values['map-file']
    named = recipes.read(values['node'])['bridge'].get('map_file', '')
    return re.sub(r'\$\{(\w+):-([^}]*)\}', lambda found: os.environ.get(found[1], found[2]), named)


def launch_words(values):
    node = values['node']
    if recipes.is_recipe(node):
        node = os.path.join(recipes.folder(), f'{node}.launch')
    words = [os.path.abspath(node)] if os.path.isfile(node) else node.split()
    return words + [word.replace('=', ':=', 1) if ':=' not in word else word for word in shlex.split(values['node-args'] or '')]


def start_master(stack):
    """A roscore on a free port, as environment. It is a roslaunch, which guard_launch gives more time than a roscore has."""
    port = stack.enter_context(reserved_port())
    which('roslaunch')
    environment = {'ROS_MASTER_URI': f'http://127.0.0.1:{port}', 'ROS_IP': '127.0.0.1'}
    start(stack, ['roslaunch', '--core', '-p', str(port)], subprocess.DEVNULL, environment)
    return environment


def start(stack, command, output, environment=()):
    """A program that ends, with all that it started, when the stack is left, or when this process is killed."""
    guard = [which('setpriv'), '--pdeathsig', 'TERM', program('guard_launch')]
    process = subprocess.Popen([*guard, *command], stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                               start_new_session=True, env={**os.environ, **dict(environment)})
    stack.callback(end, process)
    return process


def end(process):
    process.terminate()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def tail_of(path, lines=15):
    with open(path, encoding='utf-8', errors='replace') as file:
        return ''.join(file.readlines()[-lines:])
