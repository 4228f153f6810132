"""Where things are: programs and packages of the workspace, and sequences below a root."""
import glob
import os
import sys

from options import did_you_mean


class NotBuilt(Exception):
    """The workspace lacks what a command needs."""


def prefixes():
    """The devel or install spaces that are sourced, and the one that this program is in."""
    own = os.path.dirname(os.path.dirname(os.path.realpath(sys.argv[0])))
    return [own, *filter(None, os.environ.get('CMAKE_PREFIX_PATH', '').split(':'))]


def find_program(name, package='pcrb_tools'):
    """Path of a program of a package, or None."""
    for prefix in prefixes():
        path = os.path.join(prefix, 'lib', package, name)
        if os.access(path, os.X_OK):
            return path
    return None


def package_folder(package):
    """Folder of a package's files, or None."""
    for prefix in prefixes():
        path = os.path.join(prefix, 'share', package)
        if os.path.isfile(os.path.join(path, 'package.xml')):
            return path
    for folder in os.environ.get('ROS_PACKAGE_PATH', '').split(':'):
        for path in [folder, *sorted(glob.glob(os.path.join(folder, '*'))), *sorted(glob.glob(os.path.join(folder, '*', '*')))]:
            if package_name(path) == package:
                return path
    return None


def package_name(folder):
    try:
        with open(os.path.join(folder, 'package.xml'), encoding='utf-8') as file:
            return file.read().partition('<name>')[2].partition('</name>')[0].strip()
    except OSError:
        return ''


def launch_file(name):
    folder = package_folder('pcrb_launch')
    return os.path.join(folder, name) if folder else None


def core():
    """The Python package of pcrb_core, which says what sequences and methods there are: loaded when it is needed."""
    for prefix in prefixes():
        for folder in sorted(glob.glob(os.path.join(prefix, 'lib', 'python3*', '*-packages'))):
            if os.path.isdir(os.path.join(folder, 'pcrb')) and folder not in sys.path:
                sys.path.append(folder)
    try:
        import pcrb
    except ImportError as error:
        raise NotBuilt(f'found no Python package pcrb ({error}): source devel/setup.bash of a workspace that is built') from error
    return pcrb


def known_methods():
    """The methods that have a parameter file: those of this suite, and its baselines."""
    files = glob.glob(os.path.join(package_folder('pcrb_launch') or '', 'config', 'methods', '*.yaml'))
    return sorted(os.path.splitext(os.path.basename(file))[0] for file in files)


def problem_files(root, kind='both'):
    """(data set, sequence, kind, path) of each problem file below a root; none where there is no such folder."""
    if not os.path.isdir(root):
        return []
    return [found for found in core().find_sequences(root) if kind in ('both', None, found[2])]


def cloud_folders(root):
    """(data set, sequence) of each folder of clouds below a root."""
    folders = sorted({os.path.dirname(path) for path in glob.glob(os.path.join(root, '*', '*', '*.pcd'))})
    return [tuple(folder.split(os.sep)[-2:]) for folder in folders]


def problem_sequences(values):
    """(data set, sequence) of the problem files below --root."""
    return [(data_set, sequence) for data_set, sequence, _, _ in problem_files(values['root'])]


def all_sequences(values):
    """Those that have problem files or clouds."""
    return [*problem_sequences(values), *cloud_folders(values['root'])]


def select(names, known, place):
    """Those of (data set, sequence) that some words name, by the rule of all programs: all, a sequence, a data set, or
    data_set/sequence.

    Returns them and a list of mistakes: words that name nothing.
    """
    pcrb, chosen, mistakes = core(), [], []
    for name in names or ['all']:
        try:
            found = pcrb.select_sequences(known, [name])
        except pcrb.InvalidParameter:
            words = {word for pair in known for word in (*pair, '/'.join(pair))}
            mistakes.append(f'--sequences: found nothing called `{name}` in {place}' + (did_you_mean(name, words) or ''))
            continue
        chosen += [pair for pair in found if pair not in chosen]
    return chosen, mistakes
