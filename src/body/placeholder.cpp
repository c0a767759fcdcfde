namespace furrow {}
