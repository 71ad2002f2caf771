"""Settings to begin with: what we recommend, what the paper printed, and learning without knowing the world."""

from typing import Any

from irl_core import DEFAULT_LEARNERS

PRESETS: tuple[dict[str, Any], ...] = (
    {
        "name": "recommended",
        "title": "Recommended",
        "learners": list(DEFAULT_LEARNERS),
        "settings": {},
        "sentence": "The paper’s four, held to calm steps, and Bayesian IRLFR, which also says how sure it is.",
    },
    {
        "name": "paper",
        "title": "As the paper prints it",
        "learners": ["meirl", "irlr", "irlf", "irlfr"],
        "settings": {"lambda_min": 0.5, "initial_weights": "uniform", "inference": "ziebart"},
        "sentence": "Random first weights, Algorithm 1 to the letter, and λ falling to 0.5. There the failures "
        "count for so much that IRLF and IRLFR often swing and explode: worth seeing once.",
    },
    {
        "name": "model-free",
        "title": "Model-free",
        "learners": ["model_free"],
        "settings": {"episodes": 500},
        "sentence": "One learner that is not told where steps lead: it plays 500 episodes in each iteration to find "
        "out, and takes longer.",
    },
)
