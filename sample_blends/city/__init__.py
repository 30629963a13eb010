"""Four city maps (figure 5.7): the plots and streets of a real quarter, and three that are generated."""
