#!/usr/bin/env python3
"""localization.launch with a node that is started anew on purpose, or cannot be started; node_supervisor alone."""
import os
import re
import subprocess
import sys

import rospkg
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Child, executable, forget_results, rows, run_info, wait_until
from pcrb_testing_bridge import SupervisedTestCase


class SupervisorTest(SupervisedTestCase):

    def processes(self, launch):
        """The processes that the node under test was, as roslaunch says, when the run has ended."""
        launch.wait()
        return set(re.findall(rf'process\[{self.NODE[1:]}-\d+\]: started with pid \[(\d+)\]', launch.output()))

    def test_a_node_may_be_started_anew_for_each_target(self):
        launch = self.launch(restart='target')
        self.assertGreaterEqual(len(self.processes(launch)), 2)
        self.assert_finished(launch, len(self.data.of('local', 'hall')))

    def test_a_node_may_be_started_anew_for_each_problem_and_is_not_started_before(self):
        file = self.write('restart.yaml', 'restart: problem\n')
        for name, how in ('argument', {'restart': 'problem'}), ('file', {'bridge_parameters': file}):
            launch = self.launch(run=self.path(name), subset=3, **how)
            self.assertEqual(len(self.processes(launch)), 3, name)
            self.assertEqual([row['outcome'] for row in rows(self.path(name))], ['replied'] * 3)

    def test_a_node_that_does_not_come_ends_the_launch_when_its_limit_is_up(self):
        launch = self.launch(node_launch='', node_args='', connect_limit=10)
        launch.wait()
        self.assertRegex(launch.output(), r'within 10 s \(~connect_limit; .*/pcrb/localization_bridge')

    def test_a_launch_file_that_fails_at_once_ends_the_whole_launch(self):
        for arguments, reason in (
                ({'node_launch': 'localization_standins no_such.launch', 'node_args': ''}, r'no_such\.launch'),
                ({'node_args': 'map_topic=/points_map scn_topic=/points_raw'},
                 r'ndt_localizer\.launch: found argument `scn_topic`, expected map_topic, scan_topic: did you mean scan_topic\?')):
            launch = self.launch(**arguments)
            launch.wait()
            self.assertRegex(launch.output(), reason)
            self.assertIn('launch file cannot be started as asked', launch.output())
            self.assertEqual(rows(self.path('run')), [])

    def test_a_run_goes_on_only_with_the_same_launch_file_programs_and_parameters(self):
        file = self.path('mine.launch')

        def launch(steps):
            self.write('mine.launch', f"""<launch>
  <arg name="map_topic"/> <arg name="scan_topic"/>
  <include file="$(find localization_standins)/launch/ndt_localizer.launch" pass_all_args="true"/>
  <param name="/ndt_localizer/steps" value="{steps}"/>
</launch>
""")
            started = self.launch(node_launch=file, subset=2)
            started.wait()
            return started.output()

        launch(steps=20)
        self.assertEqual([row['outcome'] for row in rows(self.path('run'))], ['replied'] * 2)
        noted = run_info(self.path('run'))['client_parameters'].splitlines()
        self.assertIn('node /ndt_localizer/steps: 20', noted)
        kinds = [' '.join(line.split()[:3]) for line in noted if line.startswith('node ')]
        for kind in ('node file mine.launch:', 'node file ndt_localizer.launch:', 'node program localization_standins/ndt_localizer:'):
            self.assertIn(kind, kinds)
        forget_results(self.path('run'), 'source = (SELECT MIN(source) FROM result)')  # so that it has something to go on with
        self.assertRegex(launch(steps=30), r'client_parameters: the run has `node file mine\.launch: [0-9a-f]{16}, node '
                         r'/ndt_localizer/steps: 20`, asked for `node file mine\.launch: [0-9a-f]{16}, node /ndt_localizer/steps: 30`')
        self.assertNotIn('client_parameters: ', launch(steps=20))

    def test_a_nodelets_library_is_noted_from_a_file_of_plugins_with_one_library_after_the_other(self):
        for package, export in (('nodelet', ''), ('nodelets', '<export><nodelet plugin="${prefix}/plugins.xml"/></export>')):
            self.write(f'{package}/package.xml', f'''<package><name>{package}</name><version>1.0.0</version><description>x</description>
<maintainer email="a@b.org">a</maintainer><license>BSD</license>{export}</package>''')
        self.write('nodelet/nodelet', '#!/bin/sh\n')
        os.chmod(self.path('nodelet/nodelet'), 0o755)
        self.write('nodelets/plugins.xml', '<library path="lib/libfirst"></library>\n<library path="lib/libsecond"></library>\n')
        self.write('lib/libsecond.so', 'of a nodelet')
        self.write('mine.launch', '<launch><node name="localizer" pkg="nodelet" type="nodelet" args="standalone nodelets/X"/></launch>')
        script = os.path.join(rospkg.RosPack().get_path('pcrb_server'), 'scripts', 'describe_launch.py')
        folder = os.path.dirname(self.path('mine.launch'))
        described = subprocess.run(
            [sys.executable, script, '/described', self.path('mine.launch')], stderr=subprocess.PIPE, universal_newlines=True, check=False,
            env=dict(os.environ, ROS_PACKAGE_PATH=folder + os.pathsep + os.environ['ROS_PACKAGE_PATH'],
                     CMAKE_PREFIX_PATH=folder + os.pathsep + os.environ['CMAKE_PREFIX_PATH']))
        self.assertEqual(described.returncode, 0, described.stderr)
        noted = [line.split(': ')[0] for line in rospy.get_param('/described')]
        self.assertEqual(noted, ['file mine.launch', 'program libsecond.so', 'program nodelet/nodelet'])

    def test_it_does_not_outlive_the_process_that_started_it(self):
        rospy.set_param('/orphan/node_supervisor', {'launch': 'localization_standins ndt_localizer.launch'})
        supervisor = executable('pcrb_server', 'node_supervisor')
        shell = self.start(Child(['sh', '-c', f'{supervisor} & wait'], '/orphan'))
        wait_until(self.node_process, 'the node is there')
        shell.process.kill()
        wait_until(lambda: 'the process that started node_supervisor has ended' in shell.output(), 'it says so')
        wait_until(lambda: self.node_process() is None, 'the node is gone')


if __name__ == '__main__':
    rospy.init_node('supervisor_test')
    rostest.rosrun('pcrb_launch', 'supervisor', SupervisorTest)
