#!/usr/bin/env python3
"""A client that returns the guess. After its first reply it waits until the file exists that it is given: meanwhile its run is
neither over nor idle, however slow the test is that wants to disturb it."""
import os
import sys

import rospy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing_client import Client
from pcrb_testing_wait import wait_until


class Run:
    """For Client.serve()."""

    def __init__(self, client):
        self.client = client

    def ended(self):
        return 'summary' in self.client.newest or rospy.is_shutdown()

    def rows(self):
        """What is known here of what the server has stored: it says a result when it has it."""
        return self.client.results


if __name__ == '__main__':
    rospy.init_node('gated_client')
    run = Run(Client('/pcrb'))
    run.client.serve(run, limit=1)
    wait_until(lambda: os.path.exists(sys.argv[1]) or run.ended(), 'the gate opens', limit=float('inf'))
    if not run.ended():
        run.client.serve(run)
