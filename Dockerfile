# syntax=docker/dockerfile:1

# Build: Node fetches the browser's packages, hatchling puts them and the app into one wheel.
FROM node:24-bookworm-slim AS node

FROM python:3.13-slim-bookworm AS build
COPY --from=node /usr/local/bin/node /usr/local/bin/node
COPY --from=node /usr/local/lib/node_modules /usr/local/lib/node_modules
RUN ln -s ../lib/node_modules/npm/bin/npm-cli.js /usr/local/bin/npm
WORKDIR /src
COPY requirements/build.txt requirements/runtime.txt requirements/
RUN python -m venv /app \
 && pip install --no-cache-dir --no-deps --require-hashes --only-binary :all: -r requirements/build.txt \
 && /app/bin/pip install --no-cache-dir --no-deps --require-hashes --only-binary :all: -r requirements/runtime.txt
COPY . .
RUN pip wheel --no-cache-dir --no-deps --no-build-isolation --wheel-dir /wheels . \
 && /app/bin/pip install --no-cache-dir --no-deps /wheels/*.whl

# Run: Python, the locked packages, and a user who owns nothing but the data; compiled kernels are kept there too.
FROM python:3.13-slim-bookworm
RUN useradd --uid 10001 --create-home irlfr && install --directory --owner=irlfr --group=irlfr /data
COPY --from=build /app /app
ENV PATH=/app/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    IRLFR_HOST=0.0.0.0 \
    IRLFR_PORT=8000 \
    IRLFR_DATABASE_URL=sqlite:////data/irlfr.sqlite3 \
    NUMBA_CACHE_DIR=/data/compiled
USER irlfr
WORKDIR /data
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=30s --timeout=5s --start-period=20s CMD ["python", "-c", "import os, urllib.request; urllib.request.urlopen(f'http://127.0.0.1:{os.environ[\"IRLFR_PORT\"]}/healthz', timeout=4)"]
STOPSIGNAL SIGTERM
CMD ["irlfr", "serve"]
