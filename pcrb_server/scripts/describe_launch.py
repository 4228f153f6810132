#!/usr/bin/env python3
"""Checks a launch file's arguments, and notes as a ROS parameter what it starts: what a run's results come from.

describe_launch.py PARAMETER FILE|PACKAGE FILE [name:=value ...]

The parameter is a list of `what: value`: hash of each launch file and of each program, and each parameter that it sets. An
argument that the launch file does not have, or one that it needs and does not get, ends this with status 1: the mistakes are
the list `launch_mistakes` beside that parameter.
"""
import difflib
import hashlib
import os
import re
import sys

import rosgraph
import roslaunch
import roslaunch.arg_dump
import roslaunch.config
import roslaunch.rlutil
import roslaunch.xmlloader
import roslib.packages
import rospkg

LONGEST = 200  # characters of a parameter; of a longer one its hash is noted


def hash_of(content):
    return hashlib.sha256(content).hexdigest()[:16]


def hash_of_file(path):
    with open(path, 'rb') as file:
        return hash_of(file.read())


def argument_mistakes(path, given):
    """A line for each argument that is unknown or missing."""
    known = roslaunch.arg_dump.get_args([path])
    mistakes = []
    for name in given:
        if name not in known:
            close = difflib.get_close_matches(name, known, 1, 0.5)
            mistakes.append(f'{path}: found argument `{name}`, expected ' + (', '.join(sorted(known)) or 'none')
                            + (f': did you mean {close[0]}?' if close else ''))
    for name, (_, default) in sorted(known.items()):
        if default is None and name not in given:
            mistakes.append(f'{path}: argument `{name}` must be given')
    return mistakes


def load(path, arguments):
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader(resolve_anon=False).load(path, config, argv=arguments, verbose=False)
    return config


class NotFound(Exception):
    pass


def program_of(node):
    """Path of a node's program."""
    try:
        found = roslib.packages.find_node(node.package, node.type)
    except rospkg.ResourceNotFound as error:
        raise NotFound(f'found no package `{error.args[0]}`, expected one of a workspace that is sourced') from error
    if not found:
        raise NotFound(f'found no program {node.type} of package {node.package}: is it built?')
    return found[0]


def programs_of(nodes):
    """Hashes of the programs and nodelets; roslaunch goes on without those that are not there, unless none is."""
    hashes, missing = {}, []
    for node in nodes:
        try:
            hashes[f'{node.package}/{node.type}'] = hash_of_file(program_of(node))
            hashes.update({os.path.basename(path): hash_of_file(path) for path in libraries_of(node)})
        except NotFound as error:
            missing.append(error)
            hashes[f'{node.package}/{node.type}'] = 'not found'
    if missing and len(missing) == len(nodes):
        raise missing[0]
    for error in missing:
        print(f'[node_supervisor] the node\'s launch file goes on without one of its nodes: {error}', flush=True)
    return hashes


def libraries_of(node):
    """Paths of the libraries that the nodelet of a node may be in."""
    nodelet = re.match(r'(?:standalone|load) (\w+)/', node.args or '') if node.package == 'nodelet' else None
    if not nodelet:
        return []
    try:
        files = rospkg.RosPack().get_manifest(nodelet[1]).get_export('nodelet', 'plugin')
    except rospkg.ResourceNotFound as error:
        raise NotFound(f'found no package `{error.args[0]}`, expected one of a workspace that is sourced') from error
    names = [f'{path}.so' for file in files for path in library_paths(file)]
    places = os.environ.get('CMAKE_PREFIX_PATH', '').split(os.pathsep)
    return [path for name in names for place in places for path in [os.path.join(place, name)] if os.path.isfile(path)]


def library_paths(file):
    """Paths of the libraries of a file of plugins. pluginlib reads those that are no XML, too: one <library> after the other."""
    try:
        with open(file, encoding='utf-8', errors='replace') as plugins:
            return re.findall(r'<library\s[^>]*?\bpath\s*=\s*["\']([^"\']+)', plugins.read())
    except OSError as error:
        raise NotFound(f'found no file of plugins {file}, expected one: {error.strerror}') from error


def shown(value):
    """A parameter as one line; a folder of this process alone, which each shard of a run has, by its name."""
    text, folder = str(value), os.environ.get('TMPDIR', '').rstrip('/')
    text = text.replace(folder, '$TMPDIR') if folder else text
    return text if len(text) <= LONGEST and '\n' not in text else 'hash ' + hash_of(text.encode())


def description(config):
    lines = [f'file {os.path.basename(path)}: {hash_of_file(path)}' for path in sorted(set(config.roslaunch_files))]
    lines += [f'program {name}: {value}' for name, value in sorted(programs_of(config.nodes).items())]
    return lines + [f'{name}: {shown(parameter.value)}' for name, parameter in sorted(config.params.items())]


def main(words):
    parameter, words = words[0], words[1:]
    arguments = [word for word in words if ':=' in word]
    try:
        path, = roslaunch.rlutil.resolve_launch_arguments([word for word in words if ':=' not in word])
        mistakes = argument_mistakes(path, {word.partition(':=')[0]: word for word in arguments})
        if not mistakes:
            rosgraph.Master('/describe_launch').setParam(parameter, description(load(path, arguments)))
    except (roslaunch.RLException, roslaunch.xmlloader.XmlParseException, OSError, NotFound) as error:
        mistakes = [str(error)]
    if mistakes:
        lines = [' '.join(mistake.split()) for mistake in mistakes]
        rosgraph.Master('/describe_launch').setParam(parameter.rpartition('/')[0] + '/launch_mistakes', lines)
    return 1 if mistakes else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
