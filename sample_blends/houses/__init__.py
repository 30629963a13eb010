"""Three types of houses (figure 5.7), recorded on seven plots each and applied to thirty others."""
