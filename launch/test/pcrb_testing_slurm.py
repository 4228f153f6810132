"""A Slurm of a test's own: controller, one node and munge on this machine, all on 127.0.0.1."""
import os
import pwd
import shutil
import socket
import subprocess
import time

from pcrb_testing_ports import free_ports
from pcrb_testing_wait import wait_until

REVOCATION = 3.0  # s
UNANSWERED = 'Unable to contact slurm controller', 'timed out', 'Protocol authentication error'
PROGRAMS = ('munged', 'munge', 'slurmctld', 'slurmd', 'sbatch', 'squeue', 'scontrol', 'sinfo')

CONFIGURATION = '''
ClusterName=pcrb
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=1
KillWait=5
MessageTimeout=60
TCPTimeout=30
ReturnToService=2
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
'''


def missing_programs():
    path = f'{os.environ["PATH"]}:/usr/sbin:/sbin'
    return [name for name in PROGRAMS if not shutil.which(name, path=path)]


class Cluster:
    """Starts its daemons as children of a test, which ends them."""

    def __init__(self, test, child):
        """child: the class for processes, pcrb_testing.Child."""
        self.folder = test.path('slurm')
        self._waiting_since = {}
        for name in '', 'state', 'spool':
            os.makedirs(os.path.join(self.folder, name), exist_ok=True)
        self._write_files()
        self.environment = {'SLURM_CONF': self.path('slurm.conf'), 'PATH': f'{os.environ["PATH"]}:/usr/sbin:/sbin'}
        # The folder is its owner's alone; munge wants a socket that everybody can reach, hence --force.
        self.daemons = [test.start(child(['munged', '--foreground', '--force', *(
            f'--{name}={self.path("munge." + kind)}' for name, kind in (
                ('key-file', 'key'), ('socket', 'socket'), ('pid-file', 'pid'), ('log-file', 'log'),
                ('seed-file', 'seed')))], **self.environment))]
        wait_until(self._has_munge, 'munge is there')
        for program in 'slurmctld', 'slurmd':
            self.daemons.append(test.start(child([program, '-D'], **self.environment)))
        wait_until(self._is_idle, f'the node is idle; {self.path("slurm.conf")}')

    def path(self, name):
        return os.path.join(self.folder, name)

    def _write_files(self):
        with open(os.open(self.path('munge.key'), os.O_CREAT | os.O_WRONLY, 0o400), 'wb') as file:
            file.write(os.urandom(128))
        controller_port, node_port = free_ports(2)
        with open(self.path('slurm.conf'), 'w') as file:
            file.write(CONFIGURATION.format(
                host=socket.gethostname().split('.')[0], user=pwd.getpwuid(os.geteuid()).pw_name, folder=self.folder,
                controller_port=controller_port, node_port=node_port))

    def call(self, *command):
        """Output of one of Slurm's commands, which must succeed; it is given again where a daemon did not answer in time."""
        def output():
            done = subprocess.run(command, env={**os.environ, **self.environment}, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
            is_unanswered = done.returncode < 0 or any(text in done.stderr for text in UNANSWERED)  # a signal: SIGPIPE
            if done.returncode and not is_unanswered:
                raise AssertionError(f'{command}: status {done.returncode}: {done.stderr}')
            return None if is_unanswered else [done.stdout]
        return wait_until(output, f'{command} is answered', period=0.3)[0]

    def _check_daemons(self):
        for daemon in self.daemons:
            if daemon.ended():
                raise AssertionError(f'{daemon.command[0]} ended:\n{daemon.output()}')

    def _has_munge(self):
        self._check_daemons()
        return os.path.exists(self.path('munge.socket'))

    def _is_idle(self):
        self._check_daemons()
        state = subprocess.run(['sinfo', '--noheader', '--format=%T'], env={**os.environ, **self.environment},
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return state.stdout.strip() == 'idle'

    def queue(self):
        """Job or task to (state, reason, folder that it has on the node while it runs)."""
        lines = self.call('squeue', '--noheader', '--array', '--format=%i %A %T %r').splitlines()
        fields = [line.split(maxsplit=3) for line in lines]
        return {name: (state, reason, self.path(f'spool/job{int(number):05}')) for name, number, state, reason in fields}

    def skip_requeue_delay(self):
        """Slurm gives a requeued job two minutes to end before it starts again: this lets it start some seconds after it
        has. Sooner, the node may refuse it, since it has just revoked that job's credential, in whole seconds."""
        waiting = [job for job, (state, reason, folder) in self.queue().items()
                   if state == 'PENDING' and reason == 'BeginTime' and not os.path.exists(folder)]
        now = time.monotonic()
        self._waiting_since = {job: self._waiting_since.get(job, now) for job in waiting}
        for job, since in self._waiting_since.items():
            if now - since > REVOCATION:
                self.call('scontrol', 'update', f'JobId={job}', 'StartTime=now')
