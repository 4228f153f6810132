#!/usr/bin/env python3
"""The command pcrb: one grammar, everything checked before anything starts, runs with a master of their own, verdicts."""
import contextlib
import glob
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

import rospkg
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, front_door, gated_client, open_gate, row_key, rows, run_info
from pcrb_testing_processes import marked_processes
from pcrb_testing_terminal import CTRL_C, Terminal

COMMANDS = ('prepare fetch convert overlap sample map import-protocol check run localize probe paper score report compare merge ground-truth replay bag demo '
            'doctor recipes completion options').split() + [f'convert {name}' for name in ('eth', 'planetary', 'tum', 'kaist')]


def pcrb(*words, **variables):
    return subprocess.run([front_door(), *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding='utf-8',
                          env={**os.environ, **variables}, check=False)


class PcrbCommandTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=400, perturbations=4)

    def run_of(self, name, *words, **variables):
        """A finished run of icp."""
        run = self.path(name)
        words = words or ('--method', 'icp')
        child = self.start(Child([front_door(), 'run', '--root', self.data.root, '--run', run, *words], **variables))
        self.assert_ends_well(child)
        return run, child.output()

    def assert_refused(self, words, *patterns):
        result = pcrb(*words)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(result.stdout, '')
        for pattern in patterns:
            self.assertRegex(result.stderr, pattern)

    def test_a_series_has_a_run_per_value_and_trial_and_goes_on(self):
        words = ('--method', 'icp', '--sequences', 'kitchen', '--subset', '4', '--sweep', 'voxel_leaf=0.3,0.6', '--repeat', '2')
        run, output = self.run_of('series', *words)
        folders = ['voxel_leaf=0.3/trial_1', 'voxel_leaf=0.3/trial_2', 'voxel_leaf=0.6/trial_1', 'voxel_leaf=0.6/trial_2']
        errors = [{row['problem_id']: row['error'] for row in rows(os.path.join(run, folder))} for folder in folders]
        self.assertEqual([len(trial) for trial in errors], [4] * 4)
        self.assertEqual(errors[0], errors[1])  # icp is deterministic
        self.assertNotEqual(errors[0], errors[2])
        self.assertNotIn('pcrb replay', output)
        again = pcrb('run', '--root', self.data.root, '--run', run, *words, '--json')
        self.assertEqual([one['folder'] for one in json.loads(again.stdout)['runs']], folders, again.stderr)
        self.assert_ends_well(self.start(Child([front_door(), 'report', run, '--output', self.path('report'), '--no-figures'])))
        with open(self.path('report', 'tables', 'local_trials.csv'), encoding='utf-8') as file:
            self.assertIn('voxel_leaf=0.3,total,2', file.read())
        self.assert_refused(['run', '--root', self.data.root, '--run', self.path('s'), '--repeat', '0'], '--repeat')

    def test_help_names_every_command_and_each_command_its_options(self):
        overview = pcrb('--help').stdout
        for name in COMMANDS:
            self.assertIn(f'  {name} ', overview)
            result = pcrb(*name.split(), '--help')
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f'usage: pcrb {name}', result.stdout)
            self.assertIn('Example: ', result.stdout)
            self.assertNotIn('\033', result.stdout)
        self.assertRegex(pcrb('--version').stdout, r'^pcrb \d+\.\d+\.\d+\n$')

    def test_a_converter_takes_its_log_by_place_and_every_option_of_a_command_has_a_name_of_its_own(self):
        logs = self.path('logs')
        subprocess.run([executable('pcrb_tools', 'make_sample_logs'), '--output', logs], check=True, stdout=subprocess.DEVNULL)
        bag, = glob.glob(os.path.join(logs, 'tum', '*long_office_household.bag'))
        result = pcrb('convert', 'tum', bag, '--root', self.path('clouds'), '--messages', 'depth', '--threads', '2')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(len(os.listdir(self.path('clouds', 'tum', 'long_office_household'))), 5)
        for name in COMMANDS:
            names = re.findall(r'^ +(?:-\w, )?(--[a-z-]+|[A-Z][A-Z_]+)\b', pcrb(*name.split(), '--help').stdout, re.MULTILINE)
            self.assertEqual(sorted(names), sorted(set(names)), name)

    def test_help_fits_a_terminal_of_80_columns_but_for_examples_to_copy(self):
        for name in ['', *COMMANDS]:
            for line in pcrb(*name.split(), '--help', COLUMNS='80').stdout.splitlines():
                self.assertTrue(len(line) <= 80 or line.startswith(('Example: ', 'usage: ')), f'{name}: {line}')

    def test_what_the_demo_costs_is_said_once(self):
        minutes, disk = re.search(r'report: (.*), (\d+ MB) of disk', pcrb('demo', '--help').stdout).groups()
        readme = os.path.join(rospkg.RosPack().get_path('pcrb_tools'), '..', 'README.md')
        if os.path.exists(readme):  # an install space has none
            with open(readme, encoding='utf-8') as file:
                self.assertTrue(re.search(f'demo` \\| {minutes} .*{disk}', file.read()), f'README.md: {minutes}, {disk}')

    def test_all_mistakes_are_named_with_what_was_meant_and_nothing_starts(self):
        run = self.path('run')
        self.assert_refused(['run', '--root', self.data.root, '--run', run, 'subst:=5', '--methd', 'icp', '--kind=locl', '--jobs', '0'],
                            r'subst:=: did you mean --subset\?', r'--methd: did you mean --method\?', 'did you mean local',
                            'found 0, expected 1 to 1024')
        self.assert_refused(['run', '--root', self.data.root, '--run', run, '--method', 'gcip'], r'did you mean gicp\?')
        self.assert_refused(['run', '--root', self.data.root, '--run', run, '--sequences', 'kitchn'], r'did you mean kitchen\?')
        self.assert_refused(['run', '--run', run, '--root', self.path('nowhere')], 'expected a folder that is there')
        self.assert_refused(['localize', '--root', self.data.root, '--run', run, '--node', 'hdl_localisation'],
                            'expected a launch file, a package and its launch file, or hdl_localization, .*did you mean hdl_localization')
        for words in ['check', '--strict'], ['paper', '--run', run], ['ground-truth', '--output', run]:
            self.assert_refused([*words, '--root', self.data.root, '--sequences', 'kitchn'], r'did you mean kitchen\?')
        self.assert_refused(['run', '--root', self.data.root, '--run', run, '--method', 'mine', '--plugin', self.path('libmine.so')],
                            '--plugin: found .*libmine.so`, expected a file that is there')
        self.assert_refused(['demo', '--output', os.path.join(self.data.root, 'rooms', 'kitchen_local.txt')], '--output: found a file')
        self.assert_refused(['--hlep'], r'did you mean --help\?')
        self.assert_refused(['rnu'], r'did you mean run\?')
        self.assert_refused(['convert', 'kaitsu'], r'did you mean kaist\?')
        self.assert_refused(['compare', self.data.root], 'OLD: .*results.sqlite|NEW: must be given')
        self.assert_refused(['report', '--formt', 'csv', self.data.root, '--output', run], r'did you mean --format\?')
        self.assert_refused(['overlap', '--root', self.data.root, '--sequences', 'halll'], r'did you mean hall\?')
        self.assertFalse(os.path.exists(run))

    def test_a_run_has_its_own_master_a_table_the_next_commands_and_no_alarm(self):
        run, output = self.run_of('run', '--method', 'icp', 'sequences:=kitchen', ROS_MASTER_URI='http://127.0.0.1:1')
        self.assertEqual({row['sequence'] for row in rows(run)}, {'kitchen'})
        self.assertRegex(output, r'total +local +')
        self.assertIn(f'pcrb replay --run {run} --order worst', output)
        self.assertIn(f'pcrb report {run} --output {run}/report', output)
        self.assertNotIn('REQUIRED', output)
        again = pcrb('run', '--root', self.data.root, '--run', run, '--method', 'icp', '--sequences', 'kitchen', '--json')
        self.assertEqual(again.returncode, 0, again.stderr)
        result = json.loads(again.stdout)
        self.assertEqual((result['status'], result['problems'], result['is_complete']), (0, len(rows(run)), True))
        self.assertEqual(result['sequences'][-1]['count'], len(rows(run)))

    def test_on_a_terminal_the_line_of_progress_names_method_and_sequence(self):
        mine, its = os.openpty()
        command = [front_door(), 'run', '--root', self.data.root, '--run', self.path('run'), '--method', 'icp', '--sequences', 'kitchen']
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=its) as process:
            os.close(its)
            text = b''
            with contextlib.suppress(OSError):  # the end of a terminal
                while True:
                    text += os.read(mine, 4096)
            os.close(mine)
        self.assertEqual(process.returncode, 0, text)
        self.assertRegex(text.decode(), r'icp, kitchen: \d+/12 problems \(\d+ %\), [\d.]+ problems/s')

    def test_ctrl_c_ends_a_run_with_one_line_and_the_next_one_goes_on(self):
        run, gate, mark = self.path('run'), self.path('gate'), self.path('of this run')
        command = [front_door(), 'run', '--root', self.data.root, '--run', run, '--client', gated_client(gate)]
        terminal = Terminal(command, PCRB_MARK=mark)
        terminal.wait_for(r'1/\d+ problems')
        terminal.press(CTRL_C)
        self.assertEqual(terminal.wait(), 130, terminal.text)
        waits = 'benchmark_server: waiting for a client'  # said where the client or this test is slow
        said = [line for line in re.split(r'[\r\n]+|\^C', terminal.text)
                if line.strip() and 'problems' not in line and not line.startswith(waits)]
        self.assertEqual(said, ['pcrb run: interrupted; what is complete is kept and the next run goes on from there'])
        self.assertEqual(marked_processes(mark), {})
        kept = {row_key(row): row for row in rows(os.path.join(run, 'shards', '0'))}
        self.assertEqual(len(kept), 1)
        open_gate(gate)
        child = self.start(Child(command))
        self.assert_ends_well(child)
        self.assertGreater(len(rows(run)), len(kept))
        self.assertEqual({row_key(row): row for row in rows(run) if row_key(row) in kept}, kept)

    def test_colours_are_on_a_terminal_only_where_they_are_not_unwanted(self):
        def shown(**variables):
            terminal = Terminal([front_door(), '--help'], **{'TERM': 'xterm', 'NO_COLOR': '', **variables})
            self.assertEqual(terminal.wait(), 0, terminal.text)
            return terminal.text
        self.assertIn('\033[1mRuns\033[0m', shown())
        self.assertNotIn('\033', shown(NO_COLOR='1') + shown(TERM='dumb') + pcrb('--help').stdout + pcrb('--hlep').stderr)

    def test_a_reader_that_leaves_is_no_error(self):
        for words in '--help', 'options':
            result = subprocess.run(['bash', '-c', f'{front_door()} {words} | true'], stderr=subprocess.PIPE, encoding='utf-8', check=True)
            self.assertEqual(result.stderr, '')

    def test_values_that_look_like_numbers_stay_text(self):
        for name in 'kitchen_local.txt', 'kitchen':
            os.rename(os.path.join(self.data.root, 'rooms', name), os.path.join(self.data.root, 'rooms', name.replace('kitchen', '00')))
        run, _ = self.run_of('run', '--method', 'icp', '--sequences', '00', '--kind', 'local')
        self.assertEqual(run_info(run)['sequences'], '00')

    def test_a_client_of_ones_own_is_started_and_a_run_with_the_current_master_too(self):
        client = executable('pcrb_tools', 'minimal_client.py')
        run, _ = self.run_of('client', '--client', client, '--subset', '4')
        self.assertEqual(run_info(run)['under_test'], client)
        current, output = self.run_of('current', '--method', 'icp', '--subset', '4', '--master', 'current')
        self.assertEqual(len(rows(current)), 4)
        self.assertNotIn('REQUIRED', output)
        for run in run, current:
            with open(os.path.join(run, 'shards', '0', 'roslaunch.log')) as log:
                self.assertNotIn('REQUIRED', log.read())

    def test_compare_passes_a_run_like_the_old_one_and_fails_one_that_is_worse(self):
        old, _ = self.run_of('old')
        new, _ = self.run_of('new')
        result = pcrb('compare', old, new)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertRegex(result.stdout, r'total +local +\d+ +0 > 0 .* same')
        idle, _ = self.run_of('idle', '--client', executable('pcrb_tools', 'minimal_client.py'))  # it returns the guess
        result = pcrb('compare', old, idle, '--json')
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        verdicts = {row['sequence']: row['verdict'] for row in json.loads(result.stdout)}
        self.assertEqual(verdicts, {'kitchen': 'too few pairs to tell', 'hall': 'too few pairs to tell', 'total': 'worse'})

    def test_replay_takes_a_run_of_several_methods_and_one_problem_and_says_what_it_lacks(self):
        run, _ = self.run_of('runs/icp', '--method', 'icp', '--sequences', 'kitchen', '--kind', 'local', '--subset', '4')
        worst = max(rows(run), key=lambda row: row['error'])
        problem = ['--sequences', 'rooms/kitchen', '--kind', 'local', '--problem', worst['problem_id'], '--rate', '100']
        result = pcrb('replay', '--run', self.path('runs'), '--method', 'icp', *problem)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"1/1 rooms/kitchen local {worst['problem_id']}: error {worst['error']:.3g} ", result.stdout)
        self.assertNotIn('REQUIRED', result.stdout + result.stderr)
        self.assert_refused(['replay', '--run', self.path('runs')], 'expected --method icp beside it')
        self.assert_refused(['replay', '--root', self.data.root, '--sequences', 'kitchen', '--problem', '1'], '--kind: must be given')

    def test_paper_has_a_client_of_ones_own_beside_its_methods(self):
        paper = self.path('paper')
        client = executable('pcrb_tools', 'minimal_client.py')
        result = pcrb('paper', '--root', self.data.root, '--run', paper, '--method', 'icp', 'idle', '--client', client, '--subset', '4',
                      '--no-figures')
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        with open(os.path.join(paper, 'report', 'report.json')) as file:
            section = json.load(file)['sections'][0]
        self.assertEqual([method['method'] for method in section['methods']], ['icp', 'idle'])
        with open(os.path.join(paper, 'report', 'report.tex')) as file:
            latex = file.read()
        self.assertRegex(latex, r'label\{tab:pcrb-local-medians\}\n\\begin\{tabular\}\{lrrr\}\n\\toprule\n & icp & idle & do nothing')
        self.assertEqual(latex.count('\\begin{table}'), len(set(re.findall(r'\\label\{(.*?)\}', latex))))
        self.assert_command_shows(section['worst'][1]['problems'][0])
        self.assert_refused(['paper', '--root', self.data.root, '--run', paper, '--method', 'icpp'], r'did you mean icp\?')

    def assert_command_shows(self, worst):
        """What the report offers for copying shows exactly that problem."""
        words = shlex.split(worst['command'])
        self.assertEqual((words[0], words[-1]), ('pcrb', '--rviz'))
        result = pcrb(*words[1:-1])
        self.assertEqual(result.returncode, 0, result.stderr)
        shown = re.findall(r'^1/1 .*', result.stdout, re.MULTILINE)
        self.assertEqual(len(shown), 1, result.stdout)
        self.assertIn(f"{worst['problem']}: error {worst['error']:.3g} ", shown[0])

    def test_completion_offers_commands_options_and_choices(self):
        script = pcrb('completion', 'bash').stdout

        def complete(*words):
            quoted = ' '.join(f"'{word}'" for word in words)
            return subprocess.run(['bash', '-c', f'{script}\nCOMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _pcrb; '
                                   'printf "%s\\n" "${COMPREPLY[@]}"'], stdout=subprocess.PIPE, encoding='utf-8', check=True).stdout.split()
        self.assertEqual(complete('pcrb', 'comp'), ['compare', 'completion'])
        self.assertEqual(complete('pcrb', 'run', '--sub'), ['--subset'])
        self.assertEqual(complete('pcrb', 'run', '--kind', 'lo'), ['local'])
        self.assertEqual(complete('pcrb', 'convert', 'k'), ['kaist'])
        self.assertIn('--max-rate', complete('pcrb', 'convert', 'kaist', '--max'))

    def test_completion_does_the_same_in_zsh(self):
        if shutil.which('zsh') is None:
            self.skipTest('no zsh here')
        script = self.path('completion.zsh')
        with open(script, 'w', encoding='utf-8') as file:
            file.write(pcrb('completion', 'zsh').stdout)
        terminal = Terminal(['zsh', '-f', '-i'], TERM='dumb', HOME=os.path.dirname(script))
        terminal.press(f"source '{script}'; print re''ady\n")  # what is typed is shown, too
        terminal.wait_for('ready')
        for typed, completed in (('pcrb doc', 'pcrb doctor'), ('pcrb run --sub', 'pcrb run --subset'),
                                 ('pcrb run --kind lo', 'pcrb run --kind local'), ('pcrb convert k', 'pcrb convert kaist')):
            terminal.press(f'\x15{typed}\t')  # in place of the line before
            terminal.wait_for(completed)
        self.assertNotIn('not found', terminal.text)

    def test_the_table_of_options_is_that_of_the_documents_and_no_word_means_two_things(self):
        table = pcrb('options').stdout
        names = re.findall(r'^\| `(?:-\w, )?--([\w-]+)', table, re.MULTILINE)
        self.assertEqual(len(names), len(set(names)), names)
        self.assertNotIn(' or else ', table)
        path = os.path.join(rospkg.RosPack().get_path('pcrb_tools'), '..', 'docs', 'pcrb.md')
        if os.path.exists(path):  # an install space has none
            with open(path, encoding='utf-8') as file:
                self.assertEqual(file.read(), table, 'pcrb options > docs/pcrb.md')

    def test_doctor_says_what_is_there_and_what_to_type(self):
        result = pcrb('doctor', '--root', self.data.root)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertRegex(result.stdout, r'ok +workspace')
        result = pcrb('doctor', '--root', self.path('nowhere'))
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertRegex(result.stdout, r'fix +data +.*pcrb prepare')


if __name__ == '__main__':
    rostest.rosrun('pcrb_launch', 'pcrb_command', PcrbCommandTest)
