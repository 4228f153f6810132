"""TCP ports for daemons that take a port's number, and bind it some time later."""
import contextlib
import random
import socket


def _first_ephemeral_port():
    """From here on the kernel gives ports to whoever asks for any, as every outgoing connection does."""
    with contextlib.suppress(OSError, ValueError, IndexError):
        with open('/proc/sys/net/ipv4/ip_local_port_range', encoding='ascii') as file:
            return int(file.read().split()[0])
    return 32768


def _is_free(port):
    with socket.socket() as probe, contextlib.suppress(OSError):
        probe.bind(('127.0.0.1', port))
        return True
    return False


def free_ports(count):
    """Ports of 127.0.0.1 that nobody takes by chance before they are bound, nor connects to himself while nobody listens."""
    end = _first_ephemeral_port()
    candidates = range(10000, end) if end > 11000 else range(11000, 60000)
    ports = random.sample(candidates, 50 * count)
    return [port for port in ports if _is_free(port)][:count]
