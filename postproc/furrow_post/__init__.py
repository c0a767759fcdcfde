"""Pictures, plots and tables from the results of Furrow. All statistics come from the program furrow-resistance."""
