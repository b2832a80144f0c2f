"""Run a command; its peak resident memory must stay below a limit: memory.py LIMIT_MB COMMAND..."""

import resource
import subprocess
import sys

limit, command = float(sys.argv[1]), sys.argv[2:]
subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024  # Linux counts in KiB
print(f"peak {peak:.1f} MB, limit {limit:.0f} MB")
sys.exit(peak >= limit)
