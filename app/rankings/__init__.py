"""Rankings: the orders that people confirmed, every version of them."""
