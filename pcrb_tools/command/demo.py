"""pcrb demo: from simulated logs of four data sets to a scored run and a report."""
import dataclasses
import os
import signal
import time

import places
from programs import program, run_program
from terminal import say
from words import WORDS

# The seven methods get a quarter of the first run's problems each.
OPTIONS = [dataclasses.replace(WORDS['output'], default='pcrb_demo'),
           dataclasses.replace(WORDS['subset'], low=4, default=160, shown_default='')]
COSTS = 'about 4 minutes on two processors, 250 MB of disk'  # README.md says it, too
DISK, MEMORY = 0.25e9, 2e9  # bytes


def check(values):
    output = os.path.expanduser(values['output'])
    if os.path.isfile(output):
        return [f'--output: found a file, {output}, expected a folder that is new or of an earlier demo']
    is_a_demo = os.path.isfile(os.path.join(output, 'prepare.log'))  # beside which runs of the user's own may lie
    if os.path.isdir(output) and not is_a_demo and set(os.listdir(output)) - {'CATKIN_IGNORE'}:
        return [f'--output: found files of others in {output}, expected a folder that is new or of an earlier demo']
    return []


def run(name, options, values):
    folder = os.path.abspath(os.path.expanduser(values['output']))
    os.makedirs(folder, exist_ok=True)
    say(f'demo: {COSTS}, in {folder}')
    start = time.monotonic()
    logs, data, first, paper = (os.path.join(folder, each) for each in ('logs', 'data', 'run', 'paper'))
    status = (prepare(folder, logs, data) or
              benchmark(data, first, values['subset']) or
              experiments(data, paper, max(1, values['subset'] // 4)))
    if status == 0:
        minutes = (time.monotonic() - start) / 60
        say(f'demo: done in {minutes:.1f} minutes; open {paper}/report/index.html')
        say(f'try your own: pcrb run --root {data} --run {folder}/mine --method icp --subset 40')
    return status


def prepare(folder, logs, data):
    """Logs and problems; every step goes to a log file, the last lines of which are shown if one fails."""
    say('demo, 1 of 3: simulate logs in the original formats of four data sets, and make registration problems of them')
    log = os.path.join(folder, 'prepare.log')
    with open(log, 'w', encoding='utf-8') as out:
        steps = [] if os.path.isdir(logs) else [[program('make_sample_logs'), '--output', logs]]
        steps.append([program('prepare_dataset'), '--logs', logs, '--root', data])
        for step in steps:
            status = run_program(step, stdout=out, stderr=out)
            if status == 128 + signal.SIGINT:
                raise KeyboardInterrupt
            if status != 0:
                with open(log, encoding='utf-8') as text:
                    print(''.join(text.readlines()[-5:]), end='')
                say(f'demo: the data could not be prepared; all of it is in {log}')
                return status
    sequences = {f'{data_set}/{sequence}' for data_set, sequence, _, _ in places.problem_files(data)}
    say(f'demo: prepared {len(sequences)} sequences; every step is in {log}')
    return 0


def benchmark(data, folder, subset):
    say(f'demo, 2 of 3: benchmark G-ICP on {subset} of their local problems, over ROS topics')
    arguments = {'root': data, 'kind': 'local', 'method': 'gicp', 'subset': subset}
    status = run_program([program('evaluate_batch'), '--run', folder, '--jobs', '1',
                          *(f'{name}:={value}' for name, value in arguments.items())], 'pcrb demo')
    if status == 0:
        say(f'demo: {folder} has results.csv, results.sqlite and the summary above, summary.txt')
    return status


def experiments(data, folder, subset):
    say(f'demo, 3 of 3: the paper\'s experiments, {subset} problems for each of its seven methods')
    return run_program([program('run_paper'), '--root', data, '--run', folder, '--subset', str(subset)], 'pcrb demo')
