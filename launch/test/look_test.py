#!/usr/bin/env python3
"""What the rviz configurations show, on a screen without a monitor: for each role there is a picture with
its colour in it, and one, its topic being off, without.

PCRB_PICTURES=FOLDER keeps the pictures, for people to look at.
"""
import glob
import os
import sys

import numpy as np
import roslib.packages
import rospy
import rostest
import yaml
from sensor_msgs.msg import Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, wait_until
from pcrb_testing_screen import Screen, count, require_screen, started_and_seen
from pcrb_testing_wait import LIMIT

WHITE = (255, 255, 255)  # of texts


def color(text):
    return tuple(int(part) for part in text.split(';'))


def rviz_configuration(name):
    return os.path.join(roslib.packages.get_pkg_dir('pcrb_launch'), 'rviz', f'{name}.rviz')


def roles(name):
    """Background, and the colour of each topic that a configuration shows; axes have none of their own, arrows shades."""
    with open(rviz_configuration(name)) as file:
        manager = yaml.safe_load(file)['Visualization Manager']
    topics = {}
    for display in manager['Displays']:
        topic = display.get('Topic') or display.get('Marker Topic')
        if topic and display['Enabled'] and not display['Class'].startswith('rviz/Pose'):
            topics[topic] = color(display['Color']) if 'Color' in display else WHITE
    return color(manager['Global Options']['Background Color']), topics


class LookTest(TestCase):

    def setUp(self):
        require_screen()
        super().setUp()
        self.data = maths.make_data_set(self.path('root'))
        os.mkdir(self.path('screen'))
        self.screen = self.start(Screen(self.path('screen')))

    def replay(self, name='replay', **parameters):
        """Shows its last scene for as long as the test lasts, and leaves the master in good order for the next."""
        rospy.set_param(f'/pcrb/{name}', {'rate': 1000, 'keep_alive': True, **parameters})
        self.addCleanup(rospy.delete_param, f'/pcrb/{name}')
        replay = self.start(Child([executable('pcrb_server', 'replay'), f'__name:={name}'], '/pcrb'))
        replay.wait_for_output('at the end')
        self.addCleanup(replay.wait)
        self.addCleanup(replay.interrupt)

    def look(self, configuration, background, shown, hidden):
        """Starts rviz with some topics off; the part of the picture that it draws, once the others are seen."""
        off = [f'{topic}:=/nowhere{topic}' for topic in hidden]
        command = ['rviz', '-s', '', '-d', rviz_configuration(configuration), *off]
        rviz, picture = started_and_seen(lambda: self.start(Child(command, HOME=self.folder, **self.screen.environment())), Child.kill,
                                         self.screen, background, list(shown.values()))
        if os.environ.get('PCRB_PICTURES'):
            names = '_'.join(topic.rpartition('/')[2] for topic in shown)
            self.screen.save(os.path.join(os.environ['PCRB_PICTURES'], f'{configuration}_{names}.ppm'))
        rviz.kill()
        return picture

    def assert_shows_every_role(self, configuration):
        background, topics = roles(configuration)
        self.assertGreaterEqual(len(topics), 2)
        halves = {}, {}
        for i, (topic, role_color) in enumerate(topics.items()):
            halves[i % 2][topic] = role_color
        for shown, hidden in halves, halves[::-1]:
            picture = self.look(configuration, background, shown, hidden)
            for topic, role_color in hidden.items():
                self.assertEqual(count(picture, role_color), 0, f'{topic} is off')

    def run_of_guesses(self, **parameters):
        server = self.server(self.data, sequences='hall', **parameters)
        self.client(server).serve(server)
        self.assert_ends_well(server)

    def test_a_sequence(self):
        self.replay(root=self.data.root, sequence='hall', map_leaf=0.3)
        self.assert_shows_every_role('sequence')

    def test_a_run(self):
        self.run_of_guesses()
        self.replay(run=self.path('run'))
        self.assert_shows_every_role('benchmark')

    def test_the_view_fits_the_data_and_a_panel_says_what_is_shown(self):
        self.run_of_guesses()
        self.replay(run=self.path('run'), order='worst')
        background, topics = roles('problems')
        command = [executable('pcrb_tools', 'look'), rviz_configuration('problems')]

        def interrupt(look):
            look.interrupt()
            look.wait()

        look, _ = started_and_seen(
            lambda: self.start(Child(command, HOME=self.folder, TMPDIR=self.folder, **self.screen.environment())), interrupt,
            self.screen, background, [topics['/pcrb/source_aligned']])
        panel = rospy.wait_for_message('/pcrb/panel', Image, LIMIT)
        pixels = np.frombuffer(panel.data, np.uint8).reshape(panel.height, panel.width, 3)
        for role_color in topics.values():
            self.assertGreater((pixels == role_color).all(axis=2).sum(), 100, role_color)
        written = wait_until(lambda: glob.glob(self.path('pcrb_look*', 'problems.rviz')), 'rviz has a configuration')
        with open(written[0]) as file:
            distance = yaml.safe_load(file)['Visualization Manager']['Views']['Current']['Distance']
        extent = np.ptp(self.data.clouds['hall', maths.SEQUENCES['hall'][0]], axis=0).max()
        self.assertTrue(0.5 * extent < distance < 2.5 * extent, f'{distance} m of {extent} m')
        interrupt(look)

    def test_a_localization_node(self):
        self.run_of_guesses(presentation='localization')
        self.replay(run=self.path('run'))
        self.assert_shows_every_role('localization')

    def test_problems_and_what_became_of_them(self):
        self.run_of_guesses()
        self.replay('replay_run', run=self.path('run'))
        self.replay(root=self.data.root, sequence='hall', problems='local')
        self.assert_shows_every_role('problems')


if __name__ == '__main__':
    rospy.init_node('look_test')
    rostest.rosrun('pcrb_launch', 'look', LookTest)
