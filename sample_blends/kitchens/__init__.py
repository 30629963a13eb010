"""Kitchens (figure 5.9), recorded in nine rooms and built in sixteen others."""
