"""Another user of this machine: asks dask processes who they are, prints those that answer.

python intruder.py SECONDS PORT...
"""

import asyncio
import os
import sys

from distributed import Security
from distributed.core import rpc

NOBODY = 65534


async def answers(address: str, security: Security, seconds: float) -> bool:
    settings = security.get_connection_args("client")
    try:
        async with asyncio.timeout(seconds), rpc(address, connection_args=settings) as server:
            return "id" in await server.identity()
    except (OSError, ValueError):  # the latter if TLS is spoken to who speaks first
        return False


async def main(seconds: str, *ports: str) -> None:
    ways = [
        (f"{scheme}://127.0.0.1:{port}", security)
        for scheme, security in [("tcp", Security()), ("tls", Security.temporary())]
        for port in ports
    ]
    answered = await asyncio.gather(*(answers(*way, float(seconds)) for way in ways))
    print(*(address for (address, _), yes in zip(ways, answered, strict=True) if yes))


if __name__ == "__main__":
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)
    asyncio.run(main(*sys.argv[1:]))
