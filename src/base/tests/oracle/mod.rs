mod nearby;
