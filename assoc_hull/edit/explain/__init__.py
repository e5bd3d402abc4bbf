"""Why a hull is as it is: causes, its graph, states side by side, previews."""
