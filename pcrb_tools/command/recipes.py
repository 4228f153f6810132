"""Recipes of localization nodes, launch/config/nodes/<node>.yaml: how a known node is benchmarked, and what it scored."""
import glob
import os
import textwrap

import yaml

import places
from options import did_you_mean, one_of


def folder():
    return os.path.join(places.package_folder('pcrb_launch') or '', 'config', 'nodes')


def known():
    return sorted(os.path.splitext(os.path.basename(file))[0] for file in glob.glob(os.path.join(folder(), '*.yaml')))


def read(name):
    with open(os.path.join(folder(), f'{name}.yaml'), encoding='utf-8') as file:
        return yaml.safe_load(file)


def mistakes(node):
    """What is wrong with --node: the name of a recipe, a launch file, or a package and its launch file."""
    is_name = node and len(node.split()) == 1 and os.sep not in node and not node.endswith(('.launch', '.xml'))
    if not is_name or node in known():
        return []
    return [f'--node: found `{node}`, expected a launch file, a package and its launch file, or {one_of(known())}'
            + did_you_mean(node, known())]


def is_recipe(node):
    return node in known()


def listing():
    """A paragraph for each recipe: what it is, where it comes from, whether it was tried, what it scored."""
    return '\n'.join(text_of(name, read(name)) for name in known())


def text_of(name, recipe):
    scores = recipe.get('scores') or {}
    lines = [f'  {name}: {recipe["repository"]} at {recipe["commit"][:8]}']
    lines += wrapped('leave out', recipe['leave_out']) + wrapped('answers', recipe['answers']) + wrapped('cost', recipe['cost'])
    tried = recipe['tried']
    if not tried:
        return '\n'.join([*lines, '    not tried with the real node: as its sources say']) + '\n'
    lines.append(f'    tried with the real node on {tried["date"]}, by PCRB {tried["commit"]}')
    for sequence, score in scores.items():
        tuned = ' (its settings were found on it)' if sequence in recipe['tuned_on'] else ''
        lines.append(f'    {sequence}{tuned}: median {score["median"]:g} (do nothing {score["do_nothing"]:g}), {score["replied"]} of '
                     f'{score["problems"]} replied, scans used: {score["scans"]:g}, of {score["time_per_scan"]:g} s each')
    return '\n'.join(lines) + '\n'


def wrapped(title, text):
    return textwrap.wrap(f'{title}: {text}', 110, initial_indent='    ', subsequent_indent='      ')
