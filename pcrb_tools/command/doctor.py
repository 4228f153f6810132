"""pcrb doctor: what this machine has and lacks; each line is ok, or says what to type."""
import dataclasses
import glob
import importlib.util
import os
import shutil
import socket

import demo
import places
import terminal
from benchmarking import has_master
from options import Option
from words import WORDS

OPTIONS = [
    dataclasses.replace(WORDS['root'], kind='path', metavar='DIR'),
    Option('folder', 'folder whose free disk space is looked at', 'path', 'DIR', default='.'),
]
MODULES = ('rospy', 'rosbag', 'jinja2', 'matplotlib', 'numpy', 'yaml')
PROGRAMS = ('roslaunch', 'rosrun', 'rosbag', 'rviz')
GIGABYTE = 1e9


def check(values):
    return []


def run(name, options, values):
    findings = [*machine(values), *ros(), *workspace(), *data(values)]
    width = max(len(what) for _, what, _ in findings)
    for state, what, text in findings:
        color = {'ok': 'green', 'note': 'yellow'}.get(state, 'red')
        print(f'{terminal.paint(state.ljust(4), color)}  {what.ljust(width)}  {text}')
    failed = sum(state == 'fix' for state, _, _ in findings)
    print('all is well' if not failed else f'{failed} to fix: each line says what to type')
    return 1 if failed else 0


def machine(values):
    system = 'unknown'
    for line in read_lines('/etc/os-release'):
        if line.startswith('PRETTY_NAME='):
            system = line.partition('=')[2].strip('"')
    yield 'ok', 'system', f'{system}, {os.cpu_count()} processors'
    memory = memory_bytes()
    if memory:
        state = 'ok' if memory >= demo.MEMORY else 'note'
        yield state, 'memory', f'{memory / GIGABYTE:.1f} GB (the demo takes {demo.MEMORY / GIGABYTE:g} GB)'
    folder = os.path.abspath(os.path.expanduser(values['folder']))
    while not os.path.isdir(folder):
        folder = os.path.dirname(folder)
    free = shutil.disk_usage(folder).free
    is_enough = free >= 2 * demo.DISK
    advice = '' if is_enough else f': the demo takes {demo.DISK / GIGABYTE:g} GB, free some'
    yield ('ok' if is_enough else 'fix'), 'disk', f'{free / GIGABYTE:.1f} GB free at {folder}{advice}'


def ros():
    for name in PROGRAMS:
        path = shutil.which(name)
        need = 'note' if name == 'rviz' else 'fix'
        yield ('ok', name, path) if path else (need, name, f'apt install {name if name == "rviz" else "ros-base-dev"}')
    for name in MODULES:
        if importlib.util.find_spec(name) is None:
            yield 'fix', f'python3 {name}', f'apt install python3-{name}'
    yield from addresses()
    uri = os.environ.get('ROS_MASTER_URI', 'http://localhost:11311')
    yield 'ok', 'master', f'{"one answers" if has_master() else "none"} at {uri}; pcrb run starts one of its own'
    if not os.environ.get('DISPLAY'):
        yield 'note', 'display', 'none, so no rviz: on another machine, ssh -X; here, xvfb-run'


def addresses():
    for variable in ('ROS_HOSTNAME', 'ROS_IP'):
        name = os.environ.get(variable)
        if name:
            try:
                socket.getaddrinfo(name, None)
                yield 'ok', variable, name
            except OSError:
                yield 'fix', variable, f'{name} is not known here: unset {variable}, or export ROS_IP=127.0.0.1'
            return
    try:
        socket.getaddrinfo(socket.gethostname(), None)
    except OSError:
        yield 'fix', 'host name', f'{socket.gethostname()} is not known here: export ROS_IP=127.0.0.1'


def workspace():
    folder = places.package_folder('pcrb_launch')
    if folder is None:
        yield 'fix', 'workspace', 'source devel/setup.bash of the workspace that PCRB is built in'
        return
    yield 'ok', 'workspace', folder
    for package, name in (('pcrb_server', 'benchmark_server'), ('pcrb_server', 'localization_bridge'),
                          ('pcrb_tools', 'registration_node'), ('pcrb_tools', 'evaluate_batch'), ('pcrb_tools', 'report')):
        if places.find_program(name, package) is None:
            yield 'fix', name, './catkin_ws_setup.sh build'
    try:
        yield 'ok', 'python3 pcrb', os.path.dirname(places.core().__file__)
    except places.NotBuilt:
        yield 'fix', 'python3 pcrb', 'apt install pybind11-dev python3-numpy, then ./catkin_ws_setup.sh build'
    yield 'ok', 'methods', ', '.join(places.known_methods())


def data(values):
    if not values['root']:
        return
    root = os.path.expanduser(values['root'])
    files = places.problem_files(root)
    if not files:
        yield 'fix', 'data', f'no problem files below {root}: pcrb prepare or pcrb fetch makes some'
        return
    names = sorted({f'{data_set}/{sequence}' for data_set, sequence, _, _ in files})
    shown = ', '.join(names[:6]) + (' ...' if len(names) > 6 else '')
    yield 'ok', 'data', f'{len(files)} problem files of {len(names)} sequences: {shown}'
    for data_set, sequence, kind, path in files:
        folder = os.path.join(root, data_set, 'box_met' if sequence == 'planetary_map' else sequence)
        if not glob.glob(os.path.join(folder, '*.pcd')) and sequence != 'planetary_map':
            yield 'fix', f'{data_set}/{sequence}', f'no clouds in {folder}: pcrb fetch --logs LOGS --root {root} --sequences {data_set}/{sequence}'


def read_lines(path):
    try:
        with open(path, encoding='utf-8') as file:
            return file.read().splitlines()
    except OSError:
        return []


def memory_bytes():
    for line in read_lines('/proc/meminfo'):
        if line.startswith('MemTotal:'):
            return int(line.split()[1]) * 1024
    return 0
